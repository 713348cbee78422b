/** The conditions of a test as fields: docs/reference/evaluation.md. */

import type { FileForm } from "../../filedialog.ts";
import { fieldsForm, type Group } from "../../fieldsform.ts";
import { date, field } from "../../toml.ts";

const TEST: Group = {
  title: "Test",
  fields: [
    field("", "name", "Name of the test", "X axis before compensation"),
    field("", "machine", "Machine, serial number", "gantry in hall 3, XK-0815"),
    field("", "axis", "Axis", "X"),
    field("", "instrument", "Instrument, serial number", "laser interferometer L-77"),
    date("", "date", "Date"),
    field("", "temperature", "Temperature of the machine", "21.9 ± 0.2 degC"),
  ],
};

const UNCERTAINTY: Group = {
  title: "Instrument, for the measuring uncertainty (ISO/TR 230-9)",
  fields: [
    field("uncertainty", "device_expanded", "Its calibration, U (k = 2)", "0.5 um/m"),
    field("uncertainty", "misalignment_range", "Range of the lateral offset of the beam", "1 mm"),
    field("uncertainty", "expansion", "Coefficient of expansion that was used", "11.5 ± 1 um/(m·K)"),
    field("uncertainty", "eve_range", "Range of the drift during the test", "1.2 um"),
  ],
};

const CIRCLE: Group = {
  title: "Nominal circle, as commanded",
  fields: [
    field("circle", "radius", "Radius", "150 mm"),
    field("circle", "centre", "Centre", "0 0 mm"),
    field("circle", "plane", "Plane, where columns do not name it", "XY"),
    field("circle", "at", "Other axes", "Z=-100 C=0"),
    field("circle", "feed", "Feed", "1000 mm/min"),
    field("circle", "length_u", "Standard uncertainty of a calibrated ball-bar", "0.5 um"),
    field("circle", "pitch_first", "Pitch of the screw or scale of the first axis", "10 mm"),
    field("circle", "pitch_second", "Pitch of that of the second axis", "10 mm"),
  ],
};

const VOLUME: Group = {
  title: "Volume of the diagonals",
  fields: [field("volume", "edges", "Edges", "500 400 300 mm")],
};

const GEOMETRY: Group = {
  title: "Geometric test (ISO 230-1)",
  fields: [
    field("test", "kind", "Kind", "straightness"),
    field("test", "reference", "Reference", "minimum zone"),
    field("test", "base", "Distance of the feet of a level or mirror", "100 mm"),
    field("test", "reading_u", "Standard uncertainty of a reading", "0.3 um"),
    field("test", "artefact_u", "Standard uncertainty of straightedge or square", "0.5 um"),
    field("test", "error", "Error of the machine file", "EYX"),
    field("test", "tolerance", "Tolerance", "8 um"),
  ],
};

const PROBING: Group = {
  title: "Probing",
  fields: [
    field("probing", "ring_diameter", "Diameter of the ring", "50.0012 ± 0.0003 mm"),
    field("probing", "sphere_diameter", "Diameter of the sphere", "25.0004 ± 0.0002 mm"),
    field("probing", "stylus_diameter", "Diameter of the stylus ball", "6 mm"),
    field("probing", "form_u", "Standard uncertainty of the form of ring and sphere", "0.1 um"),
    field("probing", "tolerance_2d", "Tolerance of a ring", "5 um"),
    field("probing", "tolerance_3d", "Tolerance of a sphere", "8 um"),
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
    "What is not known may stay empty. Numbers with their units.",
    GROUPS[standard] ?? [TEST, UNCERTAINTY],
  );
}
