/** What the names of errors mean, in words: all texts of the glossary. Signs are those of docs/conventions.md. */

import { tr } from "../words/index.ts";
import { handed, third, turnOf, type ErrorName, type Letter } from "./names.ts";

export interface ErrorText {
  /** ISO 230-1 in words. */
  title: string;
  /** What it is of the axis. */
  what: string;
  unit: "µm" | "µrad";
  kind: string;
  sign: string;
  /** What the tool does if the axis carries the workpiece. */
  carries: string;
  instruments: string;
}

/** From which direction to which a positive rotation turns. */
const TURN: Record<Letter, [Letter, Letter]> = { X: ["Y", "Z"], Y: ["Z", "X"], Z: ["X", "Y"] };

/** Pitch and yaw are words for horizontal axes. */
function tiltTitle(axis: string, own: Letter, about: Letter): string {
  if (own === "Z") return tr`tilt about ${about} of ${axis} (rotation about ${about})`;
  return about === "Z" ? tr`yaw of ${axis} (rotation about ${about})` : tr`pitch of ${axis} (rotation about ${about})`;
}

function linearMotion({ axis, own, how, direction }: ErrorName & { own: Letter }): [string, string] {
  if (how === "along")
    return direction === own
      ? [tr`positioning error of ${axis}`, tr`How far ${axis} is from where it was commanded, along itself.`]
      : [
          tr`straightness error of ${axis} in ${direction}`,
          tr`How far ${axis} leaves its straight line in ${direction} while it travels.`,
        ];
  if (direction === own)
    return [
      tr`roll of ${axis} (rotation about itself)`,
      tr`How the carriage of ${axis} turns about its direction of travel.`,
    ];
  return [
    tiltTitle(axis, own, direction),
    tr`How the carriage of ${axis} turns about ${direction} while it travels. What is far from the guideway moves by the distance times the angle (Abbe).`,
  ];
}

function rotaryMotion({ axis, own, how, direction }: ErrorName & { own: Letter }): [string, string] {
  if (how === "about")
    return direction === own
      ? [tr`angular positioning error of ${axis}`, tr`How far ${axis} has turned from where it was commanded.`]
      : [
          tr`tilt error motion of ${axis} about ${direction}`,
          tr`How the axis of rotation of ${axis} tilts about ${direction} during a turn.`,
        ];
  return direction === own
    ? [tr`axial error motion of ${axis}`, tr`How ${axis} moves along its axis of rotation during a turn.`]
    : [
        tr`radial error motion of ${axis} in ${direction}`,
        tr`How the centre of ${axis} moves in ${direction} during a turn.`,
      ];
}

function linearLocation({ axis, own, how, direction }: ErrorName & { own: Letter }): [string, string] {
  if (how === "along")
    return direction === own
      ? [tr`zero position error of ${axis}`, tr`How far the zero of ${axis} is from its place.`]
      : [
          tr`position error of ${axis} in ${direction}`,
          tr`How far the whole guideway of ${axis} is from its place, in ${direction}.`,
        ];
  if (direction === own)
    return [
      tr`orientation error of ${axis} about itself`,
      tr`How the body that ${axis} carries is turned about the direction of travel.`,
    ];
  const to = third(own, direction);
  return [
    tr`squareness error of ${axis} to ${to} (orientation about ${direction})`,
    tr`How far the angle between ${axis} and ${to} is from 90°.`,
  ];
}

function rotaryLocation({ axis, own, how, direction }: ErrorName & { own: Letter }): [string, string] {
  if (how === "along")
    return direction === own
      ? [
          tr`position error of ${axis} along its axis`,
          tr`How far the table or head of ${axis} is from its place along the axis of rotation.`,
        ]
      : [
          tr`position error of the axis of ${axis} in ${direction}`,
          tr`How far the axis of rotation of ${axis} is from its place, in ${direction}.`,
        ];
  if (direction === own) return [tr`zero angle error of ${axis}`, tr`How far the zero of ${axis} is turned.`];
  const to = third(own, direction);
  return [
    tr`orientation error of ${axis} about ${direction} (squareness to ${to})`,
    tr`How the axis of rotation of ${axis} leans, about ${direction}; its angle to ${to} is not 90°.`,
  ];
}

function mounting({ body, how, direction }: ErrorName): [string, string] {
  if (body === "workpiece")
    return how === "along"
      ? [
          tr`position of the workpiece in ${direction}`,
          tr`How the workpiece is mounted: its place differs from the nominal one.`,
        ]
      : [
          tr`orientation of the workpiece about ${direction}`,
          tr`How the workpiece is mounted: its direction differs from the nominal one.`,
        ];
  return how === "along"
    ? [
        tr`position of the tool holder in ${direction}`,
        tr`How the tool holder is mounted: its place differs from the nominal one.`,
      ]
    : [
        tr`orientation of the tool holder about ${direction}`,
        tr`How the tool holder is mounted: its direction differs from the nominal one.`,
      ];
}

function words(error: ErrorName): [string, string] {
  const { own } = error;
  if (own === null) return mounting(error);
  const known = { ...error, own };
  if (error.kind === "motion") return error.body === "linear" ? linearMotion(known) : rotaryMotion(known);
  return error.body === "linear" ? linearLocation(known) : rotaryLocation(known);
}

function displaced({ name, direction, body, axis }: ErrorName): string {
  if (body === "workpiece") return tr`${name} > 0: the workpiece is displaced towards +${direction}.`;
  if (body === "tool") return tr`${name} > 0: the tool holder is displaced towards +${direction}.`;
  return tr`${name} > 0: the body of ${axis} is displaced towards +${direction}.`;
}

function signOf(error: ErrorName): string {
  const { name, direction, how, kind, body, own, axis } = error;
  if (how === "along") return displaced(error);
  const [a, b] = TURN[direction];
  const turn = tr`${name} > 0: a rotation in the positive sense about ${direction}, from +${a} towards +${b}.`;
  if (kind !== "location" || own === null || own === direction) return turn;
  // The positive direction of the axis, turned about `direction`, leans towards direction × own.
  const to = third(own, direction);
  const leaning = body === "linear" ? tr`The + direction of ${axis}` : tr`The + direction of the axis of ${axis}`;
  const lean =
    handed(direction, own) > 0
      ? tr`${leaning} leans towards +${to}: its angle to +${to} is smaller than 90°.`
      : tr`${leaning} leans towards −${to}: its angle to +${to} is larger than 90°.`;
  return `${turn} ${lean}`;
}

const carriesOf = ({ name, body, axis }: ErrorName): string =>
  body === "tool"
    ? tr`The tool deviates by the same amount.`
    : body === "workpiece"
      ? tr`The workpiece is displaced: the tool deviates by −${name} in it.`
      : tr`If ${axis} carries the tool, the tool deviates by ${name} with its levers; if ${axis} carries the workpiece, by −${name} in the workpiece, whatever the sense of the axis.`;

function instrumentsOf({ kind, how, direction, body, own }: ErrorName): string {
  if (body === "workpiece") return tr`Setting the part up: touch probe on the datum surfaces.`;
  if (body === "tool") return tr`Tool setting probe or presetter; a mandrel and dial gauges at two heights.`;
  const is_own = direction === own;
  if (kind === "motion" && body === "linear") {
    if (how === "along")
      return is_own
        ? tr`Laser interferometer, step gauge, comparator scale; a ball bar sees its scale. Tests of ISO 230-2.`
        : tr`Straightedge and dial gauge (reversal), straightness interferometer, alignment laser, taut wire; grid encoder.`;
    if (is_own)
      return direction === "Z"
        ? tr`Two straightness runs at different offsets; multi-axis laser.`
        : tr`Electronic levels, or two straightness runs at different offsets; multi-axis laser.`;
    return direction === "Z"
      ? tr`Angular interferometer, autocollimator; a level does not see rotations about the vertical.`
      : tr`Angular interferometer, autocollimator, electronic levels.`;
  }
  if (kind === "motion")
    return how === "about" && is_own
      ? tr`Polygon and autocollimator, rotary laser calibrator, reference index table. Tests of ISO 230-7 and ISO 230-2.`
      : how === "about"
        ? tr`Mandrel or two spheres at different heights with displacement sensors (ISO 230-7); R-test with two ball heights.`
        : tr`Sphere or mandrel with displacement sensors (ISO 230-7), R-test, ball bar on the turning table.`;
  if (body === "linear") {
    if (how === "along")
      return tr`Is set to zero by the reference of the axis; seen only against other axes, by a touch probe or an R-test.`;
    return is_own
      ? tr`Level or dial gauge across the carriage; seen only through the bodies it carries.`
      : tr`Square and dial gauge, ball bar in the plane of both axes (ISO 230-4), diagonals (ISO 230-6), straightness interferometer with optical square, grid encoder.`;
  }
  return how === "along"
    ? tr`R-test, touch probe on a sphere over turns of the table, ball bar with the axis turning (ISO 10791-6), programs of the control for its rotary centres.`
    : is_own
      ? tr`Dial gauge along the edge of the table, touch probe on a reference surface.`
      : tr`Ball bar with the axis turning, R-test or sphere at two heights, dial gauge on a mandrel or on the face of the table.`;
}

function kindOf({ kind, body, axis }: ErrorName): string {
  if (kind === "location") return tr`Location error (the 0 in the name): one number, the same at every position.`;
  return body === "rotary"
    ? tr`Error motion: a function of the commanded angle of ${axis}.`
    : tr`Error motion: a function of the commanded position of ${axis}.`;
}

export function textOf(error: ErrorName): ErrorText {
  const [title, what] = words(error);
  return {
    title,
    what,
    unit: error.how === "along" ? "µm" : "µrad",
    kind: kindOf(error),
    sign: signOf(error),
    carries: carriesOf(error),
    instruments: instrumentsOf(error),
  };
}

/** "E, B: rotation about Y, X: of X", as the name is read. */
export function readOf({ how, direction, kind, axis }: ErrorName): string {
  const way =
    how === "along"
      ? tr`${direction} displacement in ${direction}`
      : tr`${turnOf(direction)} rotation about ${direction}`;
  const of = axis === "w" ? tr`w of the workpiece` : axis === "t" ? tr`t of the tool` : tr`${axis} of axis ${axis}`;
  return [tr`E error`, way, ...(kind === "location" ? [tr`0 location`] : []), of].join(" · ");
}
