/** The heading of a report as fields: docs/reference/report.md. */

import { tr } from "../../words/index.ts";
import type { FileForm } from "../../filedialog.ts";
import { fieldsForm, type Group } from "../../fieldsform.ts";
import { date, field } from "../../toml.ts";

const GROUPS: readonly Group[] = [
  {
    title: tr`Report`,
    fields: [
      { ...field("report", "number", tr`Number`, "2026-117"), needed: true },
      { ...date("report", "date", tr`Date`), needed: true },
      field("report", "customer", tr`Customer`, tr`Example Turbines`),
      field("report", "machine", tr`Machine`, tr`gantry in hall 3`),
      field("report", "machine_serial", tr`Serial number of the machine`, "XK-0815"),
      field("report", "operator", tr`Operator`, "A. Meyer"),
      field("report", "place", tr`Place`, tr`hall 3`),
      field("report", "conditions", tr`Conditions`, tr`20.3 ± 0.2 degC, table empty`),
      field("report", "remarks", tr`Remarks`, tr`before the overhaul of the C axis`),
      field("report", "logo", tr`Logo: SVG, PNG or JPEG beside this file`, "logo.svg"),
      { ...field("report", "signatures", tr`Signatures, between commas`, tr`measured, approved`), kind: "texts" },
    ],
  },
  {
    title: tr`Instrument: with its name, certificate and day of calibration`,
    fields: [
      field("report.instrument[]", "name", tr`Instrument`, tr`laser interferometer`),
      field("report.instrument[]", "serial", tr`Serial number`, "L-77"),
      field("report.instrument[]", "certificate", tr`Certificate`, "K 2026-0042"),
      date("report.instrument[]", "calibrated", tr`Calibrated`),
      date("report.instrument[]", "valid_until", tr`Valid until`),
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
  const note = tr`It stands above the report, with lines for signatures below. A further instrument: edit the file.`;
  return fieldsForm("Heading of reports", note, GROUPS, {
    "report.date": today(),
    "report.signatures": tr`measured, approved`,
  });
}
