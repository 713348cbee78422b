/** What the names of errors mean, in words: all texts of the glossary. Signs are those of docs/conventions.md. */

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

const BODY = { workpiece: "the workpiece", tool: "the tool holder" };

/** From which direction to which a positive rotation turns. */
const TURN: Record<Letter, string> = { X: "+Y towards +Z", Y: "+Z towards +X", Z: "+X towards +Y" };

function bodyOf(error: ErrorName): string {
  if (error.body === "workpiece" || error.body === "tool") return BODY[error.body];
  return `${error.axis}`;
}

/** Pitch and yaw are words for horizontal axes. */
function tiltWord(own: Letter, about: Letter): string {
  if (own === "Z") return `tilt about ${about}`;
  return about === "Z" ? "yaw" : "pitch";
}

function linearMotion({ axis, own, how, direction }: ErrorName & { own: Letter }): [string, string] {
  if (how === "along")
    return direction === own
      ? [`positioning error of ${axis}`, `How far ${axis} is from where it was commanded, along itself.`]
      : [
          `straightness error of ${axis} in ${direction}`,
          `How far ${axis} leaves its straight line in ${direction} while it travels.`,
        ];
  if (direction === own)
    return [
      `roll of ${axis} (rotation about itself)`,
      `How the carriage of ${axis} turns about its direction of travel.`,
    ];
  return [
    `${tiltWord(own, direction)} of ${axis} (rotation about ${direction})`,
    `How the carriage of ${axis} turns about ${direction} while it travels. What is far from the guideway moves by the distance times the angle (Abbe).`,
  ];
}

function rotaryMotion({ axis, own, how, direction }: ErrorName & { own: Letter }): [string, string] {
  if (how === "about")
    return direction === own
      ? [`angular positioning error of ${axis}`, `How far ${axis} has turned from where it was commanded.`]
      : [
          `tilt error motion of ${axis} about ${direction}`,
          `How the axis of rotation of ${axis} tilts about ${direction} during a turn.`,
        ];
  return direction === own
    ? [`axial error motion of ${axis}`, `How ${axis} moves along its axis of rotation during a turn.`]
    : [
        `radial error motion of ${axis} in ${direction}`,
        `How the centre of ${axis} moves in ${direction} during a turn.`,
      ];
}

function linearLocation({ axis, own, how, direction }: ErrorName & { own: Letter }): [string, string] {
  if (how === "along")
    return direction === own
      ? [`zero position error of ${axis}`, `How far the zero of ${axis} is from its place.`]
      : [
          `position error of ${axis} in ${direction}`,
          `How far the whole guideway of ${axis} is from its place, in ${direction}.`,
        ];
  if (direction === own)
    return [
      `orientation error of ${axis} about itself`,
      `How the body that ${axis} carries is turned about the direction of travel.`,
    ];
  const to = third(own, direction);
  return [
    `squareness error of ${axis} to ${to} (orientation about ${direction})`,
    `How far the angle between ${axis} and ${to} is from 90°.`,
  ];
}

function rotaryLocation({ axis, own, how, direction }: ErrorName & { own: Letter }): [string, string] {
  if (how === "along")
    return direction === own
      ? [
          `position error of ${axis} along its axis`,
          `How far the table or head of ${axis} is from its place along the axis of rotation.`,
        ]
      : [
          `position error of the axis of ${axis} in ${direction}`,
          `How far the axis of rotation of ${axis} is from its place, in ${direction}.`,
        ];
  if (direction === own) return [`zero angle error of ${axis}`, `How far the zero of ${axis} is turned.`];
  const to = third(own, direction);
  return [
    `orientation error of ${axis} about ${direction} (squareness to ${to})`,
    `How the axis of rotation of ${axis} leans, about ${direction}; its angle to ${to} is not 90°.`,
  ];
}

function words(error: ErrorName): [string, string] {
  const { own } = error;
  if (own === null) {
    const body = bodyOf(error);
    const way =
      error.how === "along"
        ? `position of ${body} in ${error.direction}`
        : `orientation of ${body} about ${error.direction}`;
    return [
      way,
      `How ${body} is mounted: its ${error.how === "along" ? "place" : "direction"} differs from the nominal one.`,
    ];
  }
  const known = { ...error, own };
  if (error.kind === "motion") return error.body === "linear" ? linearMotion(known) : rotaryMotion(known);
  return error.body === "linear" ? linearLocation(known) : rotaryLocation(known);
}

function signOf(error: ErrorName): string {
  const { name, direction, how, kind, body, own } = error;
  if (how === "along")
    return `${name} > 0: ${body === "linear" || body === "rotary" ? `the body of ${error.axis}` : bodyOf(error)} is displaced towards +${direction}.`;
  const turn = `${name} > 0: a rotation in the positive sense about ${direction}, from ${TURN[direction]}.`;
  if (kind !== "location" || own === null || own === direction) return turn;
  // The positive direction of the axis, turned about `direction`, leans towards direction × own.
  const to = third(own, direction);
  const towards = handed(direction, own) > 0 ? "+" : "−";
  const angle = towards === "+" ? "smaller" : "larger";
  return `${turn} The + direction of ${error.axis === own || body === "linear" ? error.axis : `the axis of ${error.axis}`} leans towards ${towards}${to}: its angle to +${to} is ${angle} than 90°.`;
}

const carriesOf = ({ name, body, axis }: ErrorName): string =>
  body === "tool"
    ? "The tool deviates by the same amount."
    : body === "workpiece"
      ? `The workpiece is displaced: the tool deviates by −${name} in it.`
      : `If ${axis} carries the tool, the tool deviates by ${name} with its levers; if ${axis} carries the workpiece, by −${name} in the workpiece, whatever the sense of the axis.`;

function instrumentsOf({ kind, how, direction, body, own }: ErrorName): string {
  if (body === "workpiece") return "Setting the part up: touch probe on the datum surfaces.";
  if (body === "tool") return "Tool setting probe or presetter; a mandrel and dial gauges at two heights.";
  const is_own = direction === own;
  if (kind === "motion" && body === "linear") {
    if (how === "along")
      return is_own
        ? "Laser interferometer, step gauge, comparator scale; a ball bar sees its scale. Tests of ISO 230-2."
        : "Straightedge and dial gauge (reversal), straightness interferometer, alignment laser, taut wire; grid encoder.";
    if (is_own)
      return direction === "Z"
        ? "Two straightness runs at different offsets; multi-axis laser."
        : "Electronic levels, or two straightness runs at different offsets; multi-axis laser.";
    return direction === "Z"
      ? "Angular interferometer, autocollimator; a level does not see rotations about the vertical."
      : "Angular interferometer, autocollimator, electronic levels.";
  }
  if (kind === "motion")
    return how === "about" && is_own
      ? "Polygon and autocollimator, rotary laser calibrator, reference index table. Tests of ISO 230-7 and ISO 230-2."
      : how === "about"
        ? "Mandrel or two spheres at different heights with displacement sensors (ISO 230-7); R-test with two ball heights."
        : "Sphere or mandrel with displacement sensors (ISO 230-7), R-test, ball bar on the turning table.";
  if (body === "linear") {
    if (how === "along")
      return "Is set to zero by the reference of the axis; seen only against other axes, by a touch probe or an R-test.";
    return is_own
      ? "Level or dial gauge across the carriage; seen only through the bodies it carries."
      : "Square and dial gauge, ball bar in the plane of both axes (ISO 230-4), diagonals (ISO 230-6), straightness interferometer with optical square, grid encoder.";
  }
  return how === "along"
    ? "R-test, touch probe on a sphere over turns of the table, ball bar with the axis turning (ISO 10791-6), programs of the control for its rotary centres."
    : is_own
      ? "Dial gauge along the edge of the table, touch probe on a reference surface."
      : "Ball bar with the axis turning, R-test or sphere at two heights, dial gauge on a mandrel or on the face of the table.";
}

export function textOf(error: ErrorName): ErrorText {
  const [title, what] = words(error);
  const moves = error.body === "rotary" ? "angle" : "position";
  return {
    title,
    what,
    unit: error.how === "along" ? "µm" : "µrad",
    kind:
      error.kind === "motion"
        ? `Error motion: a function of the commanded ${moves} of ${error.axis}.`
        : `Location error (the 0 in the name): one number, the same at every position.`,
    sign: signOf(error),
    carries: carriesOf(error),
    instruments: instrumentsOf(error),
  };
}

/** "E, B: rotation about Y, X: of X", as the name is read. */
export function readOf({ how, direction, kind, axis }: ErrorName): string {
  const letter = how === "along" ? direction : turnOf(direction);
  const way = how === "along" ? `displacement in ${direction}` : `rotation about ${direction}`;
  const of = axis === "w" ? "the workpiece" : axis === "t" ? "the tool" : `axis ${axis}`;
  return `E error · ${letter} ${way}${kind === "location" ? " · 0 location" : ""} · ${axis} of ${of}`;
}
