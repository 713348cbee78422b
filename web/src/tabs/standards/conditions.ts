/** The conditions of a test as fields: docs/reference/evaluation.md. */

import { tr } from "../../words/index.ts";
import type { FileForm } from "../../filedialog.ts";
import { fieldsForm, type Group } from "../../fieldsform.ts";
import { date, field } from "../../toml.ts";

const TEST: Group = {
  title: tr`Test`,
  fields: [
    field("", "name", tr`Name of the test`, "X axis before compensation"),
    field("", "machine", tr`Machine, serial number`, "gantry in hall 3, XK-0815"),
    field("", "axis", tr`Axis`, "X"),
    field("", "instrument", tr`Instrument, serial number`, "laser interferometer L-77"),
    date("", "date", tr`Date`),
    field("", "temperature", tr`Temperature of the machine`, "21.9 ± 0.2 degC"),
  ],
};

const UNCERTAINTY: Group = {
  title: tr`Instrument, for the measuring uncertainty (ISO/TR 230-9)`,
  fields: [
    field("uncertainty", "device_expanded", tr`Its calibration, U (k = 2)`, "0.5 um/m"),
    field("uncertainty", "misalignment_range", tr`Range of the lateral offset of the beam`, "1 mm"),
    field("uncertainty", "expansion", tr`Coefficient of expansion that was used`, "11.5 ± 1 um/(m·K)"),
    field("uncertainty", "eve_range", tr`Range of the drift during the test`, "1.2 um"),
  ],
};

const CIRCLE: Group = {
  title: tr`Nominal circle, as commanded`,
  fields: [
    field("circle", "radius", tr`Radius`, "150 mm"),
    field("circle", "centre", tr`Centre`, "0 0 mm"),
    field("circle", "plane", tr`Plane, where columns do not name it`, "XY"),
    field("circle", "at", tr`Other axes`, "Z=-100 C=0"),
    field("circle", "feed", tr`Feed`, "1000 mm/min"),
    field("circle", "length_u", tr`Standard uncertainty of a calibrated ball-bar`, "0.5 um"),
    field("circle", "pitch_first", tr`Pitch of the screw or scale of the first axis`, "10 mm"),
    field("circle", "pitch_second", tr`Pitch of that of the second axis`, "10 mm"),
  ],
};

const VOLUME: Group = {
  title: tr`Volume of the diagonals`,
  fields: [field("volume", "edges", tr`Edges`, "500 400 300 mm")],
};

const GEOMETRY: Group = {
  title: tr`Geometric test (ISO 230-1)`,
  fields: [
    field("test", "kind", tr`Kind`, "straightness"),
    field("test", "reference", tr`Reference`, "minimum zone"),
    field("test", "base", tr`Distance of the feet of a level or mirror`, "100 mm"),
    field("test", "reading_u", tr`Standard uncertainty of a reading`, "0.3 um"),
    field("test", "artefact_u", tr`Standard uncertainty of straightedge or square`, "0.5 um"),
    field("test", "error", tr`Error of the machine file`, "EYX"),
    field("test", "tolerance", tr`Tolerance`, "8 um"),
  ],
};

const PROBING: Group = {
  title: tr`Probing`,
  fields: [
    field("probing", "ring_diameter", tr`Diameter of the ring`, "50.0012 ± 0.0003 mm"),
    field("probing", "sphere_diameter", tr`Diameter of the sphere`, "25.0004 ± 0.0002 mm"),
    field("probing", "stylus_diameter", tr`Diameter of the stylus ball`, "6 mm"),
    field("probing", "form_u", tr`Standard uncertainty of the form of ring and sphere`, "0.1 um"),
    field("probing", "tolerance_2d", tr`Tolerance of a ring`, "5 um"),
    field("probing", "tolerance_3d", tr`Tolerance of a sphere`, "8 um"),
  ],
};

const GROUPS: Record<string, readonly Group[]> = {
  "iso230-1": [TEST, GEOMETRY],
  "iso230-3": [TEST],
  "iso230-4": [TEST, CIRCLE],
  "iso230-6": [TEST, UNCERTAINTY, VOLUME],
  "iso230-7": [TEST],
  "iso230-10": [TEST, PROBING],
};

/** The form for the readings of a file. */
export function conditionsForm(standard: string, readings: string): FileForm {
  return fieldsForm(
    `Conditions of ${readings.replace(/^.*\//, "")}`,
    tr`What is not known may stay empty. Numbers with their units.`,
    GROUPS[standard] ?? [TEST, UNCERTAINTY],
  );
}
