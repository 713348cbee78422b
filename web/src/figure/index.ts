export { bars, type Bar, type BarSpec } from "./bars.ts";
export { lineChart, scatter, type Axis, type ChartSpec, type Limit, type Series } from "./chart.ts";
export { colourBar, type ColourBarSpec } from "./colourbar.ts";
export {
  colourTable,
  css,
  diverging,
  divergingDark,
  rangeOf,
  sequential,
  seriesColour,
  type ColourMap,
  type Rgb,
} from "./colours.ts";
export {
  csvOf,
  exportMenu,
  figure,
  fileName,
  ticks,
  type Column,
  type Drawing,
  type Figure,
  type FigureSource,
} from "./figure.ts";
export { heatmap, type HeatmapSpec } from "./heatmap.ts";
export { polar, type PolarCircle, type PolarSeries, type PolarSpec } from "./polar.ts";
export { fairMagnification, vectors, type VectorSet, type VectorSpec } from "./vectors.ts";
export { sparkline, type SparkSpec } from "./sparkline.ts";
