import type { Dictionary } from "../index.ts";

export const texts: Dictionary = {
  "Open readings …": "打开读数 …",
  "{0} is not kept by this browser any more": "此浏览器中已不再保存 {0}",
  "Drop it here again.": "请重新拖放到此处。",
  "Choose a campaign: it names the machine, the unknown errors and the readings of its instruments.":
    "请选择测量方案：其中给出机床、未知误差和各仪器的读数。",
  "Which instrument are the readings in {0} of? Choose it above.": "{0} 中的读数来自哪台仪器？请在上方选择。",
  "Fitting the errors to the readings, and checking them on readings held out …":
    "正在由读数拟合误差，并用留出的读数检验 …",
  "identifying from {0}": "正在由 {0} 辨识",
  "A CSV of readings that is dropped anywhere on this page is used with this campaign.":
    "拖放到本页任意位置的读数 CSV 文件将用于此测量方案。",
  Campaign: "测量方案",
  "no readings": "无读数",
  "Readings of the campaign": "测量方案的读数",
  "instead of the readings of": "代替以下仪器的读数：",
  "instrument, if there are several": "仪器（有多台时）",
  "Instrument of the dropped readings": "拖放读数所属的仪器",
  "of which instrument? …": "属于哪台仪器？…",
  "Errors of the machine": "机床误差",
  "Bars: value; whiskers: ± 2u, about 95 %. Grey: not significantly different from zero (|z| below 2).":
    "条形：值；误差棒：± 2u，约 95 %。灰色：与零无显著差异（|z| 小于 2）。",
  "All unknowns are observable with these readings.": "用这些读数，全部未知量均可观测。",
  "Set-up": "装夹设置",
  "Where balls, sockets and optics really sat: found along with the errors, of no interest afterwards.":
    "仪器安装：球、球座和光学镜组的实际位置；与误差一并求得，此后不再使用。",
  "Correlation of what was identified": "辨识结果的相关性",
  "not observable": "不可观测",
  "No two unknowns are correlated by more than 0.9.": "没有两个未知量的相关系数超过 0.9。",
  "The identified machine": "辨识得到的机床",
  "No machine file is offered: these readings do not support one.": "不提供机床文件：这些读数不足以支持。",
  "Save the identified machine": "保存辨识得到的机床",
  "{0} and {1}: {2} with the errors found here in place of its own, each with its uncertainty.":
    "{0} 和 {1}：{2}，其误差由此处求得的误差取代，各附不确定度。",
  "{0}: {1} with the errors found here in place of its own, each with its uncertainty.":
    "{0}：{1}，其误差由此处求得的误差取代，各附不确定度。",
  "The verdict is not good: something that these errors do not describe is left in the readings.":
    "判定不佳：读数中仍有这些误差无法描述的成分。",
  Identify: "辨识",
  "no error of the machine is unknown": "没有未知的机床误差",
  "{0} of 1 error found": "1 项误差中已求得 {0} 项",
  "{0} of {1} errors found": "{1} 项误差中已求得 {0} 项",
  Good: "良好",
  "Not good": "不佳",
  "{0} in {1}: {2}. Rank {3}, condition {4}.": "{0}，{1}：{2}。秩 {3}，条件数 {4}。",
  places: "位置",
  "Not supported by the readings, and left out: {0}.": "读数不足以支持，已略去：{0}。",
  "without errors of the machine, set-up only": "不计机床误差，仅仪器安装",
  "in sample": "拟合所用读数",
  "held out, by place": "留出的读数，按位置",
  "repeatability, from repeated readings": "重复性，由重复读数得出",
  "repeatability, as stated": "重复性，按给定值",
  "Root mean square of the residuals": "残差的均方根",
  Bar: "条形",
  "× noise": "× 噪声",
  "not observable with these readings": "用这些读数不可观测",
  lengths: "长度",
  angles: "角度",
  "All values": "全部数值",
  unknown: "未知量",
  "standard uncertainty u": "标准不确定度 u",
  "z = value / u": "z = 值 / u",
  "Not separable": "不可分离",
  "1 combination that cannot be separated": "1 个不可分离的组合",
  "{0} combinations that cannot be separated": "{0} 个不可分离的组合",
  "What would tell: ": "可用以下方法分离：",
  "{0} and {1} ({2}): their sum is better known than each": "{0} 与 {1}（{2}）：二者之和比各自更为确定",
  "{0} and {1} ({2}): their difference is better known than each": "{0} 与 {1}（{2}）：二者之差比各自更为确定",
  Outliers: "离群值",
  "studentised residual": "学生化残差",
  "Readings that move the result most": "对结果影响最大的读数",
  leverage: "杠杆值",
  "Cook’s distance": "库克距离",
  "Whether the residual follows the axes": "残差是否随轴变化",
  "places by": "位置分组依据",
  "share of it, held out, %": "所占份额（留出），%",
  "Above zero: something of the machine is left that the model does not have.": "大于零：机床仍有模型未包含的成分。",
  "None: no reading is farther off than {0} times its standard uncertainty.":
    "无：没有读数的偏离超过其标准不确定度的 {0} 倍。",
  "From the front, left, above": "从左前上方",
  "From above": "从上方",
  "From the front": "从前方",
  "From the right": "从右侧",
  "Magnification of the residuals": "残差的放大倍数",
  "before: without the errors found": "之前：不含求得的误差",
  "after: residual": "之后：残差",
  "Residuals where the machine stood": "机床各停留位置的残差",
  "Set-up of the instruments": "仪器安装",
};

/** What the server says. */
export const server: Dictionary = {
  "this model explains what can be explained": "该模型已解释全部可解释的内容",
  "this model is over-fitted: measure at more places, or seek less": "该模型过拟合：请在更多位置测量，或减少未知量",
  "more remains than noise, and it follows machine XYZ (volumetric): {0n} % of it":
    "残差仍大于噪声，且随机床 XYZ 变化（空间误差）：占 {0n} %",
  "more remains than noise, and it turns with {0}: {1n} % of it": "残差仍大于噪声，且随 {0} 旋转：占 {1n} %",
  'more remains than noise, and {0n} % of it looks like a location error that is not listed: location = "minimal" lists all':
    '残差仍大于噪声，其中 {0n} % 像是未列出的位置和方向误差：location = "minimal" 可列出全部',
  "more remains than noise, and {0n} % of it depends on the direction of approach":
    "残差仍大于噪声，其中 {0n} % 取决于趋近方向",
  "more remains than noise, and {0n} % of it drifts with time: return to the first station, warm the machine up":
    "残差仍大于噪声，其中 {0n} % 随时间漂移：请返回首个测点，并预热机床",
  "one number does not belong to the others: see the outliers, correct it or delete its row":
    "有一个数值与其他不符：见离群值，请更正或删除该行",
  "{0n} numbers do not belong to the others: see the outliers, correct them or delete their rows":
    "{0n} 个数值与其他不符：见离群值，请更正或删除这些行",
  "more remains than noise, and it follows neither the axes nor the time: look at the instrument, at its noise, at conventions":
    "残差仍大于噪声，且既不随轴也不随时间变化：请检查仪器、其噪声和符号约定",
  "stage `{0}` contradicts what was known before: the result is a mean of two set-ups":
    "阶段 `{0}` 与之前的结果矛盾：所得结果是两次仪器安装的平均",
  arrangement: "轴的布置",
  approach: "趋近方向",
};
