import type { Dictionary } from "../index.ts";

export const texts: Dictionary = {
  "the server refused": "der Server hat abgelehnt",
  "no connection to TrueAxis": "keine Verbindung zu TrueAxis",
  "Is `trueaxis serve` still running? The page reconnects by itself.":
    "Läuft `trueaxis serve` noch? Die Seite verbindet sich von selbst wieder.",
  "`trueaxis serve` was started again: open the new link that it printed.":
    "`trueaxis serve` wurde neu gestartet: den neuen Link öffnen, den es ausgegeben hat.",
  Cancel: "Abbrechen",
  "saved as {0}": "wird gespeichert als {0}",
  "a date is written 2026-11-28": "ein Datum wird 2026-11-28 geschrieben",
  "{0}: it is needed": "{0}: Angabe erforderlich",
  "{0}: what it is": "{0}: Erklärung",
  name: "Name",
  "value ({0})": "Wert ({0})",
  "no travel stated": "kein Verfahrweg angegeben",
  bed: "Bett",
  workpiece: "Werkstück",
  tool: "Werkzeug",
  link: "Glied",
  "travel (mm or deg)": "Verfahrweg (mm oder deg)",
  "{0}half width of the band ({1})": "{0}halbe Breite des Bandes ({1})",
  "{0}: {1} to {2} {3}": "{0}: {1} bis {2} {3}",
  "The first {0} of {1} rows; all of them are in the CSV file.":
    "Die ersten {0} von {1} Zeilen; alle stehen in der CSV-Datei.",
  "Save as {0}": "Als {0} speichern",
  "The numbers of this figure as a table": "Die Zahlen dieses Diagramms als Tabelle",
  Table: "Tabelle",
  "This figure as numbers and files": "Dieses Diagramm als Zahlen und Dateien",
  "deviations {0}": "Abweichungen {0}",
  "{0} per ring": "{0} je Ring",
  "{0} angle (rad)": "{0} Winkel (rad)",
  "{0} deviation ({1})": "{0} Abweichung ({1})",
  "arrows {0}": "Pfeile {0}",
  place: "Ort",
  time: "Zeit",
  "time ({0})": "Zeit ({0})",
  "{0} least ({1})": "{0} kleinster ({1})",
  "{0} greatest ({1})": "{0} größter ({1})",
  "{0}, {1}, over time. Arrow keys move the cursor, Enter goes there, plus and minus zoom.":
    "{0}, {1}, über der Zeit. Pfeiltasten bewegen die Marke, Enter geht dorthin, Plus und Minus zoomen.",
};
