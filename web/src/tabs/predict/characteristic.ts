/** The characteristics of a drawing as they are called. */

import { tr } from "../../words/index.ts";
import type { CharacteristicValue } from "./types.ts";

/** What the names begin with that the server makes; `to` is " to A|B" or nothing. */
const KINDS: Readonly<Record<string, (of: string, to: string) => string>> = {
  flatness: (of, to) => tr`flatness of ${of}${to}`,
  straightness: (of, to) => tr`straightness of ${of}${to}`,
  "straightness of lines": (of, to) => tr`straightness of lines of ${of}${to}`,
  roundness: (of, to) => tr`roundness of ${of}${to}`,
  cylindricity: (of, to) => tr`cylindricity of ${of}${to}`,
  diameter: (of, to) => tr`diameter of ${of}${to}`,
  width: (of, to) => tr`width of ${of}${to}`,
  profile: (of, to) => tr`profile of ${of}${to}`,
  "line profile": (of, to) => tr`line profile of ${of}${to}`,
  angularity: (of, to) => tr`angularity of ${of}${to}`,
  parallelism: (of, to) => tr`parallelism of ${of}${to}`,
  perpendicularity: (of, to) => tr`perpendicularity of ${of}${to}`,
  position: (of, to) => tr`position of ${of}${to}`,
  symmetry: (of, to) => tr`symmetry of ${of}${to}`,
  coaxiality: (of, to) => tr`coaxiality of ${of}${to}`,
  "circular run-out": (of, to) => tr`circular run-out of ${of}${to}`,
  "total run-out": (of, to) => tr`total run-out of ${of}${to}`,
};

/** "position of bore to A|B, projected 20 mm", made by the server, in the language of the page; a name of the part file as it is. */
export function asCharacteristic({ name, feature }: CharacteristicValue): string {
  const [kind = "", rest, more] = name.split(` of ${feature}`);
  const said = KINDS[kind];
  if (!said || rest === undefined || more !== undefined) return name;
  const [to = "", projected] = rest.split(", projected ");
  if (to !== "" && !to.startsWith(" to ")) return name;
  const datums = to === "" ? "" : tr` to ${to.slice(4)}`;
  return said(feature, datums + (projected === undefined ? "" : tr`, projected ${projected}`));
}
