/** The names of errors in the words of ISO 230-1. */

import type { ErrorEntry, Link } from "../../api.ts";

/** The letter of the axis of coordinates that a direction lies along; null if along none. */
function along(link: Link): string | null {
  const at = link.direction.findIndex((v) => Math.abs(Math.abs(v) - 1) < 1e-9);
  return at < 0 ? null : ("XYZ"[at] ?? null);
}

const linearOf = (rotation: string): string => "XYZ"["ABC".indexOf(rotation)] ?? "";

function motionWords(component: string, link: Link): string {
  const own = along(link);
  const turns = "ABC".includes(component);
  const is_own = own !== null && (turns ? linearOf(component) : component) === own;
  if (link.kind === "linear") {
    if (turns) return is_own ? "roll" : `tilt about ${linearOf(component)}`;
    return is_own ? "positioning" : `straightness in ${component}`;
  }
  if (own === null) return turns ? `error motion about ${linearOf(component)}` : `error motion in ${component}`;
  if (turns) return is_own ? "angular positioning" : `tilt about ${linearOf(component)}`;
  return is_own ? "axial error motion" : `radial error motion in ${component}`;
}

/** "EC0Y" -> "orientation of Y about Z"; "EXX" -> "positioning of X". */
export function errorWords(error: ErrorEntry, links: readonly Link[]): string {
  const link = links[error.body];
  const component = error.name[1] ?? "";
  if (!link) return error.kind;
  const body = link.kind === "workpiece" ? "workpiece" : link.kind === "tool" ? "tool" : link.name;
  if (error.kind === "motion") return `${motionWords(component, link)} of ${body}`;
  return "ABC".includes(component)
    ? `orientation of ${body} about ${linearOf(component)}`
    : `position of ${body} in ${component}`;
}

/** "um" -> "µm", as numbers are shown. */
export const unitText = (unit: string): string => unit.replace(/^u/, "µ");
