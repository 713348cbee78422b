import type { Dictionary } from "../index.ts";

export const texts: Dictionary = {
  "Station of the path": "路径上的测点",
  "Look at the stations from near": "近看测点",
  "Close up": "近景",
  Station: "测点",
  "Readings …": "读数 …",
  "Measured already? Readings opened here, or dropped anywhere on this page, go to Identify":
    "已经测量？在此打开或拖放到本页任意位置的读数将转到“辨识”",
  "Choose a campaign: it names the machine, the unknown errors, the instrument and its paths.":
    "请选择测量方案：其中给出机床、未知误差、仪器及其测量路径。",
  "Working out the paths, what they see, and their programs …": "正在计算测量路径、其可观测内容及程序 …",
  "planning {0}": "正在规划 {0}",
  "Type the readings, station by station": "逐个测点输入读数",
  "Control of the programs": "程序所用的数控系统",
  "All unknowns are observable.": "全部未知量均可观测。",
  Remarks: "备注",
  "Strokes: tool axis at every station; the tool is that of the machine file": "短线：各测点处的刀轴；刀具取自机床文件",
  "Stations of the chosen poses": "所选位姿的测点",
  "Stations of path {0}": "测量路径 {0} 的测点",
  "No.": "序号",
  "The first {0} of {1}; the slider below the machine reaches all.":
    "前 {0} 个，共 {1} 个；机床下方的滑块可到达全部测点。",
  "{0} of {1}: {2}": "{0} / {1}：{2}",
  "Program errors": "程序有错误",
  "Not all observable": "并非全部可观测",
  "All observable": "全部可观测",
  "1 program would run into something or leave the travel": "1 个程序会发生碰撞或超程",
  "{0} programs would run into something or leave the travel": "{0} 个程序会发生碰撞或超程",
  "{0} of {1} combinations observable, {2} unknowns separately": "{1} 个组合中 {0} 个可观测，{2} 个未知量可单独观测",
  "all unknowns are observable": "全部未知量均可观测",
  "{0}, {1} of program together; condition {2}.": "{0}，程序总时长 {1}；条件数 {2}。",
  path: "测量路径",
  paths: "测量路径",
  sound: "正常",
  "not sound": "不正常",
  "{0} minor": "{0} 条次要",
  "without a stop at {0} mm/min": "不停顿，{0} mm/min",
  "standing {0} s at each": "每点停 {0} s",
  "Paths and their programs": "测量路径及其程序",
  Path: "测量路径",
  Stations: "测点",
  Runs: "运行时间",
  Issues: "问题",
  "not observable alone": "不可单独观测",
  "Expected uncertainty U (k = 2) of lengths": "长度的预期不确定度 U（k = 2）",
  "Expected uncertainty U (k = 2) of angles": "角度的预期不确定度 U（k = 2）",
  "Before anybody measures: from the noise of the instrument and the poses alone. Grey: unknowns of the set-up.":
    "测量之前：仅由仪器噪声和位姿得出。灰色：仪器安装的未知量。",
  " or ": " 或 ",
  "What each path sees of 10 µm or 10 µrad, {0}": "各测量路径对 10 µm 或 10 µrad 误差的响应，{0}",
  "not seen": "无响应",
  "Largest reading along the path, for every channel of its instrument. Grey: not seen at all.":
    "沿路径的最大读数，按仪器的各通道给出。灰色：完全无响应。",
  "{0} of {1} poses, {2}{3}. {4} left out, where the tool would run into something.":
    "{1} 个位姿中选 {0} 个，{2}{3}。舍去 {4}，因刀具在该处会发生碰撞。",
  ", {0} as the campaign counts touches and poses": "，按测量方案的触测和位姿时间计为 {0}",
  pose: "位姿",
  poses: "位姿",
  "The chosen poses against a grid of as many": "所选位姿与同等数量网格的比较",
  "U (k = 2) chosen": "U（k = 2）所选",
  "grid of {0}": "{0} 点网格",
  "… {0} more lines are in the file": "… 文件中还有 {0} 行",
  "{0} lines": "{0} 行",
  "Save {0}": "保存 {0}",
  "Programs and tables of poses": "程序和位姿表",
};

/** What the server says. */
export const server: Dictionary = {
  "hits cannot be written for {0}: its probing cycles move X, Y and Z, and this machine touches by other axes; choose another control, or take the table of poses":
    "无法为 {0} 生成触测程序：其测量循环移动 X、Y、Z，而此机床用其他轴触测；请选择其他数控系统，或使用位姿表",
};
