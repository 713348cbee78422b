/** The names of errors in the words of ISO 230-1. */

import { tr } from "../../words/index.ts";
import type { ErrorEntry, Link } from "../../api.ts";

/** The letter of the axis of coordinates that a direction lies along; null if along none. */
function along(link: Link): string | null {
  const at = link.direction.findIndex((v) => Math.abs(Math.abs(v) - 1) < 1e-9);
  return at < 0 ? null : ("XYZ"[at] ?? null);
}

const linearOf = (rotation: string): string => "XYZ"["ABC".indexOf(rotation)] ?? "";

function motionWords(component: string, link: Link): string {
  const own = along(link);
  const { name } = link;
  const turns = "ABC".includes(component);
  const about = linearOf(component);
  const is_own = own !== null && (turns ? about : component) === own;
  if (link.kind === "linear") {
    if (turns) return is_own ? tr`roll of ${name}` : tr`tilt about ${about} of ${name}`;
    return is_own ? tr`positioning of ${name}` : tr`straightness in ${component} of ${name}`;
  }
  if (own === null)
    return turns ? tr`error motion about ${about} of ${name}` : tr`error motion in ${component} of ${name}`;
  if (turns) return is_own ? tr`angular positioning of ${name}` : tr`tilt about ${about} of ${name}`;
  return is_own ? tr`axial error motion of ${name}` : tr`radial error motion in ${component} of ${name}`;
}

function locationWords(component: string, { kind, name }: Link): string {
  const about = linearOf(component);
  if (kind === "workpiece")
    return about ? tr`orientation of workpiece about ${about}` : tr`position of workpiece in ${component}`;
  if (kind === "tool") return about ? tr`orientation of tool about ${about}` : tr`position of tool in ${component}`;
  return about ? tr`orientation of ${name} about ${about}` : tr`position of ${name} in ${component}`;
}

/** "EC0Y" -> "orientation of Y about Z"; "EXX" -> "positioning of X". */
export function errorWords(error: ErrorEntry, links: readonly Link[]): string {
  const link = links[error.body];
  const component = error.name[1] ?? "";
  if (!link) return error.kind;
  return error.kind === "motion" ? motionWords(component, link) : locationWords(component, link);
}

/** "um" -> "µm", as numbers are shown. */
export const unitText = (unit: string): string => unit.replace(/^u/, "µ");
