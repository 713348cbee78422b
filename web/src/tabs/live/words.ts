/** Words of times. */

import { number, NARROW_SPACE } from "../../format.ts";

/** "now", "12 s ago", "5 min ago", "3 h ago", "2 days ago". */
export function ago(seconds: number): string {
  if (seconds < 3) return "now";
  const [value, unit] =
    seconds < 90
      ? [seconds, "s"]
      : seconds < 5400
        ? [seconds / 60, "min"]
        : seconds < 172800
          ? [seconds / 3600, "h"]
          : [seconds / 86400, "days"];
  return `${number(value, 0)}${NARROW_SPACE}${unit} ago`;
}

/** The unit as it is shown. */
export function unitOf(unit: string): string {
  return unit === "um" ? "µm" : "µrad";
}
