import type { Dictionary } from "../index.ts";

export const texts: Dictionary = {
  "Station of the path": "Messposition des Messwegs",
  "Look at the stations from near": "Messpositionen aus der Nähe ansehen",
  "Close up": "Nahansicht",
  Station: "Messposition",
  "Readings …": "Messwerte …",
  "Measured already? Readings opened here, or dropped anywhere on this page, go to Identify":
    "Schon gemessen? Hier geöffnete oder auf dieser Seite abgelegte Messwerte gehen zu „Identifizieren“",
  "Choose a campaign: it names the machine, the unknown errors, the instrument and its paths.":
    "Messkampagne wählen: Sie nennt die Maschine, die unbekannten Fehler, das Messgerät und seine Messwege.",
  "Working out the paths, what they see, and their programs …":
    "Messwege, ihre Aussagekraft und ihre Programme werden berechnet …",
  "planning {0}": "{0} wird geplant",
  "Type the readings, station by station": "Messwerte Messposition für Messposition eintippen",
  "Control of the programs": "Steuerung der Programme",
  "All unknowns are observable.": "Alle Unbekannten sind beobachtbar.",
  Remarks: "Bemerkungen",
  "Strokes: tool axis at every station; the tool is that of the machine file":
    "Striche: Werkzeugachse an jeder Messposition; Werkzeug aus der Maschinendatei",
  "Stations of the chosen poses": "Messpositionen der gewählten Posen",
  "Stations of path {0}": "Messpositionen des Messwegs {0}",
  "No.": "Nr.",
  "The first {0} of {1}; the slider below the machine reaches all.":
    "Die ersten {0} von {1}; der Schieberegler unter der Maschine erreicht alle.",
  "{0} of {1}: {2}": "{0} von {1}: {2}",
  "Program errors": "Programmfehler",
  "Not all observable": "Nicht alle beobachtbar",
  "All observable": "Alle beobachtbar",
  "1 program would run into something or leave the travel": "1 Programm würde anstoßen oder den Verfahrweg verlassen",
  "{0} programs would run into something or leave the travel":
    "{0} Programme würden anstoßen oder den Verfahrweg verlassen",
  "{0} of {1} combinations observable, {2} unknowns separately":
    "{0} von {1} Kombinationen beobachtbar, {2} Unbekannte einzeln",
  "all unknowns are observable": "alle Unbekannten sind beobachtbar",
  "{0}, {1} of program together; condition {2}.": "{0}, Laufzeit der Programme zusammen {1}; Konditionszahl {2}.",
  path: "Messweg",
  paths: "Messwege",
  sound: "in Ordnung",
  "not sound": "nicht in Ordnung",
  "{0} minor": "{0} geringfügige",
  "without a stop at {0} mm/min": "ohne Halt mit {0} mm/min",
  "standing {0} s at each": "je {0} s Stillstand",
  "Paths and their programs": "Messwege und ihre Programme",
  Path: "Messweg",
  Stations: "Messpositionen",
  Runs: "Laufzeit",
  Issues: "Beanstandungen",
  "not observable alone": "allein nicht beobachtbar",
  "Expected uncertainty U (k = 2) of lengths": "Zu erwartende Unsicherheit U (k = 2) der Längen",
  "Expected uncertainty U (k = 2) of angles": "Zu erwartende Unsicherheit U (k = 2) der Winkel",
  "Before anybody measures: from the noise of the instrument and the poses alone. Grey: unknowns of the set-up.":
    "Vor jeder Messung: allein aus dem Rauschen des Messgeräts und den Posen. Grau: Unbekannte des Messaufbaus.",
  " or ": " oder ",
  "What each path sees of 10 µm or 10 µrad, {0}": "Was jeder Messweg von 10 µm oder 10 µrad erfasst, {0}",
  "not seen": "nicht erfasst",
  "Largest reading along the path, for every channel of its instrument. Grey: not seen at all.":
    "Größter Messwert längs des Messwegs, für jeden Kanal seines Messgeräts. Grau: überhaupt nicht erfasst.",
  "{0} of {1} poses, {2}{3}. {4} left out, where the tool would run into something.":
    "{0} von {1} Posen, {2}{3}. {4} ausgelassen, weil das Werkzeug dort anstoßen würde.",
  ", {0} as the campaign counts touches and poses": ", {0} mit den Zeiten der Messkampagne für Antastungen und Posen",
  pose: "Pose",
  poses: "Posen",
  "The chosen poses against a grid of as many": "Die gewählten Posen gegenüber einem Raster mit gleich vielen",
  "U (k = 2) chosen": "U (k = 2) gewählt",
  "grid of {0}": "Raster mit {0}",
  "… {0} more lines are in the file": "… {0} weitere Zeilen stehen in der Datei",
  "{0} lines": "{0} Zeilen",
  "Save {0}": "{0} speichern",
  "Programs and tables of poses": "Programme und Posentabellen",
};
