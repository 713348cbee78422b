import type { Dictionary } from "../index.ts";

export const texts: Dictionary = {
  "the server refused": "服务器拒绝了请求",
  "no connection to TrueAxis": "未连接到 TrueAxis",
  "Is `trueaxis serve` still running? The page reconnects by itself.":
    "`trueaxis serve` 是否仍在运行？页面会自动重新连接。",
  Cancel: "取消",
  "saved as {0}": "保存为 {0}",
  "a date is written 2026-11-28": "日期格式为 2026-11-28",
  "{0}: it is needed": "{0}：必填",
  "{0}: what it is": "{0}：说明",
  name: "名称",
  "value ({0})": "值 ({0})",
  "no travel stated": "未给出行程",
  bed: "床身",
  workpiece: "工件",
  tool: "刀具",
  link: "部件",
  "travel (mm or deg)": "行程 (mm 或 deg)",
  "{0}half width of the band ({1})": "{0}带宽之半 ({1})",
  "{0}: {1} to {2} {3}": "{0}：{1} 至 {2} {3}",
  "The first {0} of {1} rows; all of them are in the CSV file.": "前 {0} 行，共 {1} 行；全部数据见 CSV 文件。",
  "Save as {0}": "另存为 {0}",
  "The numbers of this figure as a table": "以表格显示此图的数据",
  Table: "表格",
  "This figure as numbers and files": "此图的数据与文件",
  "deviations {0}": "偏差 {0}",
  "{0} per ring": "每环 {0}",
  "{0} angle (rad)": "{0} 角度 (rad)",
  "{0} deviation ({1})": "{0} 偏差 ({1})",
  "arrows {0}": "箭头 {0}",
  place: "位置",
  time: "时间",
  "time ({0})": "时间 ({0})",
  "{0} least ({1})": "{0} 最小 ({1})",
  "{0} greatest ({1})": "{0} 最大 ({1})",
  "{0}, {1}, over time. Arrow keys move the cursor, Enter goes there, plus and minus zoom.":
    "{0}，{1}，随时间变化。方向键移动光标，Enter 转到该处，加号和减号缩放。",
};

/** What the server says. */
export const server: Dictionary = {
  unlimited: "无限",
};
