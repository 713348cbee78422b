/** The frame of the page in Chinese (simplified). */

import type { Words } from "./en.ts";

export const zh: Words = {
  name: "中文",
  tabs: {
    start: "开始",
    describe: "描述",
    simulate: "仿真",
    predict: "预测",
    plan: "规划",
    measure: "测量",
    identify: "辨识",
    compensate: "补偿",
    verify: "验证",
    standards: "标准",
    live: "在线",
    report: "报告",
  },
  verbs: "任务",
  language: "语言",
  theme: "浅色或深色",
  themes: { auto: "跟随系统", light: "浅色", dark: "深色" },
  progress: "进度",
  connecting: "正在连接 …",
  lost: "连接已断开，正在重试",
  close: "关闭",
  close_message: "关闭此消息",
  more: (n) => `还有 ${n} 条`,
  changed_on_disk: (path) => `${path} 在磁盘上已更改`,
  saved_elsewhere: (path) => `${path} 已在另一个窗口中保存`,
  unsaved: (n) => `${n} 个文件未保存`,
  keys: "按键",
  single_keys: "不带 Ctrl 的按键作用于页面",
  key_groups: [
    {
      title: "全部页面",
      keys: [
        ["?", "本列表"],
        ["E", "误差名称，各附示意图"],
        ["Tab, Shift+Tab", "到下一个、上一个控件"],
        ["← → Home End", "在标签和子页上移动；Enter 打开"],
        ["← → ↑ ↓", "在分隔条上：改变图形大小"],
        ["Esc", "关闭对话框"],
      ],
    },
    {
      title: "仿真",
      keys: [
        ["空格键", "播放、暂停"],
        ["← →", "后退、前进一个程序段"],
        ["Home, End", "到开头、到结尾"],
        ["G", "转到某一行"],
        ["/", "在程序中查找；Enter 下一处，Shift+Enter 上一处"],
        ["N, Shift+N", "下一个、上一个问题：碰撞、超程；没有时为提示"],
        ["↑ ↓ Page Up, Page Down", "在程序文本中：移动标记；Enter 转到该行"],
      ],
    },
    {
      title: "描述",
      keys: [
        ["Ctrl+S", "保存机床文件"],
        ["Ctrl+Z, Ctrl+Shift+Z", "撤销、重做"],
        ["Enter, Esc", "在误差输入框中：确认、恢复"],
      ],
    },
    {
      title: "三维机床",
      keys: [
        ["← → ↑ ↓", "旋转；加 Shift 平移"],
        ["+ −", "放大、缩小"],
        ["0 1 2 3", "视图：轴测图，沿 X、Y、Z"],
        ["4", "显示全部"],
        ["5", "平行投影"],
      ],
    },
    {
      title: "图表",
      keys: [
        ["← →", "在曲线上：逐点读数"],
        ["← → ↑ ↓", "在矩阵上：逐格读数"],
        ["Enter", "在时间曲线上：转到该时刻；在条形、孔或行上：选择"],
        ["+ −", "在时间曲线上：放大、显示全部"],
      ],
    },
  ],
};
