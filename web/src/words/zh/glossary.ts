import type { Dictionary } from "../index.ts";

export const texts: Dictionary = {
  "Name of the error": "误差名称",
  "Workpiece w": "工件 w",
  "Tool t": "刀具 t",
  "Axis {0}": "{0} 轴",
  What: "含义",
  Kind: "类型",
  Unit: "单位",
  Sign: "符号",
  "actual − nominal. ": "实际 − 名义。",
  "At the tool": "对刀具的影响",
  "Seen by": "检测方法",
  "Dashed: nominal. Filled: actual. The directions are those of the machine axes; ISO 230-1, docs/conventions.md.":
    "虚线：名义；填充：实际。方向为机床各轴的方向；ISO 230-1，docs/conventions.md。",
  "tilt about {0} of {1} (rotation about {2})": "{1} 绕 {0} 的倾斜（绕 {2} 的转动）",
  "yaw of {0} (rotation about {1})": "{0} 的偏摆（绕 {1} 的转动）",
  "pitch of {0} (rotation about {1})": "{0} 的俯仰（绕 {1} 的转动）",
  "positioning error of {0}": "{0} 的定位误差",
  "How far {0} is from where it was commanded, along itself.": "{0} 沿自身方向偏离指令位置的距离。",
  "straightness error of {0} in {1}": "{0} 在 {1} 方向的直线度误差",
  "How far {0} leaves its straight line in {1} while it travels.": "{0} 运动时在 {1} 方向偏离直线的距离。",
  "roll of {0} (rotation about itself)": "{0} 的滚转（绕自身方向的转动）",
  "How the carriage of {0} turns about its direction of travel.": "{0} 的滑板绕其运动方向的转动。",
  "How the carriage of {0} turns about {1} while it travels. What is far from the guideway moves by the distance times the angle (Abbe).":
    "{0} 的滑板在运动时绕 {1} 的转动。远离导轨的点的位移等于距离乘以角度（阿贝误差）。",
  "angular positioning error of {0}": "{0} 的角度定位误差",
  "How far {0} has turned from where it was commanded.": "{0} 的转角偏离指令角度的大小。",
  "tilt error motion of {0} about {1}": "{0} 绕 {1} 的倾斜误差运动",
  "How the axis of rotation of {0} tilts about {1} during a turn.": "{0} 的回转轴线在一转中绕 {1} 的倾斜。",
  "axial error motion of {0}": "{0} 的轴向误差运动",
  "How {0} moves along its axis of rotation during a turn.": "{0} 在一转中沿其回转轴线的移动。",
  "radial error motion of {0} in {1}": "{0} 在 {1} 方向的径向误差运动",
  "How the centre of {0} moves in {1} during a turn.": "{0} 的中心在一转中沿 {1} 方向的移动。",
  "zero position error of {0}": "{0} 的零点位置误差",
  "How far the zero of {0} is from its place.": "{0} 的零点偏离其应在位置的距离。",
  "position error of {0} in {1}": "{0} 在 {1} 方向的位置误差",
  "How far the whole guideway of {0} is from its place, in {1}.": "{0} 的整条导轨在 {1} 方向偏离其应在位置的距离。",
  "orientation error of {0} about itself": "{0} 绕自身方向的方向误差",
  "How the body that {0} carries is turned about the direction of travel.": "{0} 所承载的部件绕运动方向的转角。",
  "squareness error of {0} to {1} (orientation about {2})": "{0} 对 {1} 的垂直度误差（绕 {2} 的方向）",
  "How far the angle between {0} and {1} is from 90°.": "{0} 与 {1} 的夹角偏离 90° 的大小。",
  "position error of {0} along its axis": "{0} 沿其回转轴线的位置误差",
  "How far the table or head of {0} is from its place along the axis of rotation.":
    "{0} 的工作台或主轴头沿回转轴线偏离其应在位置的距离。",
  "position error of the axis of {0} in {1}": "{0} 的回转轴线在 {1} 方向的位置误差",
  "How far the axis of rotation of {0} is from its place, in {1}.": "{0} 的回转轴线在 {1} 方向偏离其应在位置的距离。",
  "zero angle error of {0}": "{0} 的零角度误差",
  "How far the zero of {0} is turned.": "{0} 的零点的转角偏差。",
  "orientation error of {0} about {1} (squareness to {2})": "{0} 绕 {1} 的方向误差（对 {2} 的垂直度）",
  "How the axis of rotation of {0} leans, about {1}; its angle to {2} is not 90°.":
    "{0} 的回转轴线绕 {1} 的倾斜；它与 {2} 的夹角不是 90°。",
  "position of the workpiece in {0}": "工件在 {0} 方向的位置",
  "How the workpiece is mounted: its place differs from the nominal one.": "工件的安装：其位置与名义位置不同。",
  "orientation of the workpiece about {0}": "工件绕 {0} 的方向",
  "How the workpiece is mounted: its direction differs from the nominal one.": "工件的安装：其方向与名义方向不同。",
  "position of the tool holder in {0}": "刀柄在 {0} 方向的位置",
  "How the tool holder is mounted: its place differs from the nominal one.": "刀柄的安装：其位置与名义位置不同。",
  "orientation of the tool holder about {0}": "刀柄绕 {0} 的方向",
  "How the tool holder is mounted: its direction differs from the nominal one.": "刀柄的安装：其方向与名义方向不同。",
  "{0} > 0: the workpiece is displaced towards +{1}.": "{0} > 0：工件向 +{1} 偏移。",
  "{0} > 0: the tool holder is displaced towards +{1}.": "{0} > 0：刀柄向 +{1} 偏移。",
  "{0} > 0: the body of {1} is displaced towards +{2}.": "{0} > 0：{1} 的部件向 +{2} 偏移。",
  "{0} > 0: a rotation in the positive sense about {1}, from +{2} towards +{3}.":
    "{0} > 0：绕 {1} 的正向转动，从 +{2} 转向 +{3}。",
  "The + direction of {0}": "{0} 的正方向",
  "The + direction of the axis of {0}": "{0} 的回转轴线的正方向",
  "{0} leans towards +{1}: its angle to +{2} is smaller than 90°.": "{0}向 +{1} 倾斜：它与 +{2} 的夹角小于 90°。",
  "{0} leans towards −{1}: its angle to +{2} is larger than 90°.": "{0}向 −{1} 倾斜：它与 +{2} 的夹角大于 90°。",
  "The tool deviates by the same amount.": "刀具产生相同大小的偏差。",
  "The workpiece is displaced: the tool deviates by −{0} in it.": "工件发生偏移：刀具在工件中的偏差为 −{0}。",
  "If {0} carries the tool, the tool deviates by {1} with its levers; if {2} carries the workpiece, by −{3} in the workpiece, whatever the sense of the axis.":
    "若 {0} 承载刀具，刀具偏差为 {1}（含阿贝臂的影响）；若 {2} 承载工件，则在工件中的偏差为 −{3}，与轴的正负方向无关。",
  "Setting the part up: touch probe on the datum surfaces.": "零件找正：用测头测量基准面。",
  "Tool setting probe or presetter; a mandrel and dial gauges at two heights.":
    "对刀测头或对刀仪；检验棒与位于两个高度的千分表。",
  "Laser interferometer, step gauge, comparator scale; a ball bar sees its scale. Tests of ISO 230-2.":
    "激光干涉仪、步距规、标准光栅尺；球杆仪可测出其比例误差。按 ISO 230-2 检验。",
  "Straightedge and dial gauge (reversal), straightness interferometer, alignment laser, taut wire; grid encoder.":
    "平尺和千分表（反转法）、直线度干涉仪、准直激光、张紧钢丝；平面光栅。",
  "Two straightness runs at different offsets; multi-axis laser.": "在不同偏距处各测一遍直线度；多自由度激光测量仪。",
  "Electronic levels, or two straightness runs at different offsets; multi-axis laser.":
    "电子水平仪，或在不同偏距处各测一遍直线度；多自由度激光测量仪。",
  "Angular interferometer, autocollimator; a level does not see rotations about the vertical.":
    "角度干涉仪、自准直仪；水平仪测不出绕铅垂方向的转动。",
  "Angular interferometer, autocollimator, electronic levels.": "角度干涉仪、自准直仪、电子水平仪。",
  "Polygon and autocollimator, rotary laser calibrator, reference index table. Tests of ISO 230-7 and ISO 230-2.":
    "多面棱体和自准直仪、激光回转轴校准仪、标准分度台。按 ISO 230-7 和 ISO 230-2 检验。",
  "Mandrel or two spheres at different heights with displacement sensors (ISO 230-7); R-test with two ball heights.":
    "检验棒或位于不同高度的两个球，配位移传感器（ISO 230-7）；采用两个球高的 R-test。",
  "Sphere or mandrel with displacement sensors (ISO 230-7), R-test, ball bar on the turning table.":
    "球或检验棒配位移传感器（ISO 230-7）、R-test、转动工作台上的球杆仪。",
  "Is set to zero by the reference of the axis; seen only against other axes, by a touch probe or an R-test.":
    "由轴的参考点置零；只能相对于其他轴，用测头或 R-test 测出。",
  "Level or dial gauge across the carriage; seen only through the bodies it carries.":
    "横放在滑板上的水平仪或千分表；只能通过其承载的部件测出。",
  "Square and dial gauge, ball bar in the plane of both axes (ISO 230-4), diagonals (ISO 230-6), straightness interferometer with optical square, grid encoder.":
    "直角尺和千分表、两轴平面内的球杆仪（ISO 230-4）、对角线测量（ISO 230-6）、带光学直角器的直线度干涉仪、平面光栅。",
  "R-test, touch probe on a sphere over turns of the table, ball bar with the axis turning (ISO 10791-6), programs of the control for its rotary centres.":
    "R-test、工作台转动中用测头测球、轴转动时的球杆仪（ISO 10791-6）、数控系统的回转中心测量循环。",
  "Dial gauge along the edge of the table, touch probe on a reference surface.":
    "千分表沿工作台边缘测量、测头测参考面。",
  "Ball bar with the axis turning, R-test or sphere at two heights, dial gauge on a mandrel or on the face of the table.":
    "轴转动时的球杆仪、两个高度的 R-test 或球、千分表测检验棒或工作台面。",
  "Location error (the 0 in the name): one number, the same at every position.":
    "位置和方向误差（名称中的 0）：一个数，在所有位置都相同。",
  "Error motion: a function of the commanded angle of {0}.": "误差运动：{0} 指令角度的函数。",
  "Error motion: a function of the commanded position of {0}.": "误差运动：{0} 指令位置的函数。",
  "{0} displacement in {1}": "{0}：沿 {1} 的位移",
  "{0} rotation about {1}": "{0}：绕 {1} 的转动",
  "w of the workpiece": "w：工件",
  "t of the tool": "t：刀具",
  "{0} of axis {1}": "{0}：{1} 轴",
  "E error": "E：误差",
  "0 location": "0：位置和方向误差",
};
