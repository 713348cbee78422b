/** The heading of a report as fields: docs/reference/report.md. */

import type { FileForm } from "../../filedialog.ts";
import { fieldsForm, type Group } from "../../fieldsform.ts";
import { date, field } from "../../toml.ts";

const GROUPS: readonly Group[] = [
  {
    title: "Report",
    fields: [
      { ...field("report", "number", "Number", "2026-117"), needed: true },
      { ...date("report", "date", "Date"), needed: true },
      field("report", "customer", "Customer", "Example Turbines"),
      field("report", "machine", "Machine", "gantry in hall 3"),
      field("report", "machine_serial", "Serial number of the machine", "XK-0815"),
      field("report", "operator", "Operator", "A. Meyer"),
      field("report", "place", "Place", "hall 3"),
      field("report", "conditions", "Conditions", "20.3 ± 0.2 degC, table empty"),
      field("report", "remarks", "Remarks", "before the overhaul of the C axis"),
      field("report", "logo", "Logo: SVG, PNG or JPEG beside this file", "logo.svg"),
      { ...field("report", "signatures", "Signatures, between commas", "measured, approved"), kind: "texts" },
    ],
  },
  {
    title: "Instrument: with its name, certificate and day of calibration",
    fields: [
      field("report.instrument[]", "name", "Instrument", "laser interferometer"),
      field("report.instrument[]", "serial", "Serial number", "L-77"),
      field("report.instrument[]", "certificate", "Certificate", "K 2026-0042"),
      date("report.instrument[]", "calibrated", "Calibrated"),
      date("report.instrument[]", "valid_until", "Valid until"),
    ],
  },
];

/** Today, as on the computer of the browser. */
function today(): string {
  const now = new Date();
  const two = (value: number): string => String(value).padStart(2, "0");
  return `${now.getFullYear()}-${two(now.getMonth() + 1)}-${two(now.getDate())}`;
}

export function headingForm(): FileForm {
  const note = "It stands above the report, with lines for signatures below. A further instrument: edit the file.";
  return fieldsForm("Heading of reports", note, GROUPS, {
    "report.date": today(),
    "report.signatures": "measured, approved",
  });
}
