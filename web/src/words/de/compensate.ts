import type { Dictionary } from "../index.ts";

export const texts: Dictionary = {
  "The deviations before and after are drawn here.": "Die Abweichungen vorher und nachher werden hier gezeichnet.",
  "Choose a study: it names the path, the measured blank and the cutter.":
    "Studie wählen: in ihr stehen Bahn, gemessenes Rohteil und Fräser.",
  "Choose a machine file: its errors are what is compensated.":
    "Maschinendatei wählen: ihre Fehler werden kompensiert.",
  "Choose an NC program of the folder.": "NC-Programm des Ordners wählen.",
  "Working out the compensation, and proving it …": "Kompensation wird berechnet und nachgewiesen …",
  "compensating {0}": "{0} wird kompensiert",
  "tables of {0}": "Tabellen für {0}",
  "Files for the control": "Dateien für die Steuerung",
  "Nothing is written before you download a file.": "Geschrieben wird erst, wenn eine Datei heruntergeladen wird.",
  "At the control": "An der Steuerung",
  "values of {0}": "Werte für {0}",
  "The values as a file": "Die Werte als Datei",
  "CSV with units in its headings.": "CSV mit Einheiten in den Spaltenköpfen.",
  "adapting the path of {0}": "Bahn von {0} wird angepasst",
  "The adapted path": "Die angepasste Bahn",
  "The adapted path must not be cut: no file.": "Die angepasste Bahn darf nicht gefräst werden: keine Datei.",
  "The figures are in the tables on the right.": "Die Kennwerte stehen in den Tabellen rechts.",
  "Simulate it": "Simulieren",
  "The compensated program": "Das kompensierte Programm",
  "A file that is there is replaced only if TrueAxis wrote it and it was not edited since. To simulate the program, save it first.":
    "Eine vorhandene Datei wird nur ersetzt, wenn TrueAxis sie geschrieben hat und sie seither nicht bearbeitet wurde. Zum Simulieren das Programm zuerst speichern.",
  "State the temperatures above, or tick “machine alone, without a part” where no part is cut, such as for a check with a laser.":
    "Oben die Temperaturen angeben oder „nur Maschine, ohne Teil“ ankreuzen, wo kein Teil bearbeitet wird, etwa bei einer Prüfung mit dem Laser.",
  "Choose the control above.": "Oben die Steuerung wählen.",
  "Choose the program as the postprocessor wrote it.":
    "Das Programm so wählen, wie der Postprozessor es geschrieben hat.",
  Compensate: "Kompensieren",
  "NC program": "NC-Programm",
  "Tables of a control": "Tabellen einer Steuerung",
  "Values of an axis": "Werte einer Achse",
  "Path on a blank": "Bahn auf Rohteil",
  "unroll loops and subprograms first": "Schleifen und Unterprogramme zuerst auflösen",
  "--flat: loops, subprograms, repeated parts and computed numbers become one flat program":
    "--flat: Schleifen, Unterprogramme, Programmteil-Wiederholungen und berechnete Zahlen werden zu einem linearen Programm",
  "tip only": "nur Werkzeugspitze",
  "--position-only: only the tip is corrected, with the linear axes":
    "--position-only: nur die Werkzeugspitze wird korrigiert, mit den Linearachsen",
  "also a program that is not proved": "auch ein nicht nachgewiesenes Programm",
  "--keep-unproved: it is marked in its heading, and has another name":
    "--keep-unproved: es ist in seinem Kopf gekennzeichnet und hat einen anderen Namen",
  "tables only, no kinematic parameters": "nur Tabellen, keine Kinematikparameter",
  "--no-kinematics: rotary centres and tilts are left to the tables":
    "--no-kinematics: Drehzentren und Neigungen bleiben den Tabellen überlassen",
  "machine alone, without a part": "nur Maschine, ohne Teil",
  "--machine-only: although the workpiece grows and its temperature is not given":
    "--machine-only: obwohl das Werkstück sich ausdehnt und seine Temperatur nicht angegeben ist",
  "beside the program": "beim Programm",
  Control: "Steuerung",
  automatic: "automatisch",
  Residual: "Restabweichung",
  "Other axes at": "Andere Achsen bei",
  "middle of the travels": "Mitte der Verfahrwege",
  Axis: "Achse",
  "Step, mm or °": "Schritt, mm oder °",
  "100 mm or 10°": "100 mm oder 10°",
  "What is compensated": "Was kompensiert wird",
  "Program for": "Programm für",
  "no program": "kein Programm",
  Machine: "Maschine",
  Temperatures: "Temperaturen",
  "scale_x=30.5 workpiece=30.5, in °C": "scale_x=30.5 workpiece=30.5, in °C",
  " Standard uncertainty of the tip by the model: at most {0} µm (k = 1) at {1} places.":
    " Standardunsicherheit der Werkzeugspitze nach dem Modell: höchstens {0} µm (k = 1), {1} Stellen betrachtet.",
  " The machine file states no uncertainties: those of the corrections are not known.":
    " Die Maschinendatei gibt keine Unsicherheiten an: die der Korrekturen sind nicht bekannt.",
  "Deviation of the actual tool, before and after": "Abweichung des Ist-Werkzeugs, vorher und nachher",
  unit: "Einheit",
  before: "vorher",
  "at line": "in Zeile",
  after: "nachher",
  "tip at the ends of blocks, largest": "Werkzeugspitze an den Satzenden, größte",
  "tip at the ends of blocks, rms": "Werkzeugspitze an den Satzenden, RMS",
  "tip between them, largest": "Werkzeugspitze dazwischen, größte",
  "tool axis at the ends of blocks, largest": "Werkzeugachse an den Satzenden, größte",
  "tool axis at the ends of blocks, rms": "Werkzeugachse an den Satzenden, RMS",
  "tool axis between them, largest": "Werkzeugachse dazwischen, größte",
  "The written program, read back and simulated on the actual machine, against the program as it was on the nominal machine; {0} ends of blocks. Curves: the largest deviation in each block. Lines are those of the program as it was.{1}":
    "Das geschriebene Programm, zurückgelesen und auf der Ist-Maschine simuliert, gegenüber dem ursprünglichen Programm auf der Soll-Maschine; {0} Satzenden. Kurven: größte Abweichung in jedem Satz. Zeilen sind die des ursprünglichen Programms.{1}",
  "line of the program as it was": "Zeile des ursprünglichen Programms",
  deviation: "Abweichung",
  "residual asked for: {0} {1}": "verlangte Restabweichung: {0} {1}",
  "Tip, before and after": "Werkzeugspitze, vorher und nachher",
  "Tip, residual deviation": "Werkzeugspitze, Restabweichung",
  "Tool axis, before and after": "Werkzeugachse, vorher und nachher",
  "The new program": "Das neue Programm",
  "The program was unrolled: its lines are not those of the program as it was.":
    "Das Programm wurde aufgelöst: seine Zeilen sind nicht die des ursprünglichen Programms.",
  "The program was unrolled: its lines are not those of the program as it was. This is its beginning.":
    "Das Programm wurde aufgelöst: seine Zeilen sind nicht die des ursprünglichen Programms. Dies ist sein Anfang.",
  "No line has changed.": "Keine Zeile hat sich geändert.",
  "{0} of {1} lines have changed{2}.": "{0} von {1} Zeilen geändert{2}.",
  "; the first {0} of them": "; die ersten {0} davon",
  "Changed lines": "Geänderte Zeilen",
  line: "Zeile",
  "as it was": "ursprünglich",
  compensated: "kompensiert",
  "Deviation of the tool over the travel of all axes": "Abweichung des Werkzeugs über den Verfahrweg aller Achsen",
  "tip largest, µm": "Werkzeugspitze größte, µm",
  "tip rms, µm": "Werkzeugspitze RMS, µm",
  "tool axis largest, µrad": "Werkzeugachse größte, µrad",
  "largest at, mm and °": "größte bei, mm und °",
  "without tables": "ohne Tabellen",
  "with tables": "mit Tabellen",
  "with tables, part zero set again": "mit Tabellen, Werkstücknullpunkt neu gesetzt",
  "with the wrong sign": "mit falschem Vorzeichen",
  "The files, read back and applied as the control does, at {0} poses, each reached from both sides. A wrong sign is about twice as bad as no table: try one position on the machine first.":
    "Die Dateien, zurückgelesen und angewandt wie von der Steuerung, in {0} Posen, jede von beiden Seiten angefahren. Ein falsches Vorzeichen ist etwa doppelt so schlecht wie keine Tabelle: zuerst eine Position an der Maschine prüfen.",
  BETTER: "BESSER",
  "NOT BETTER": "NICHT BESSER",
  "with the tables the tip deviates by up to {0} µm instead of {1} µm over the travel, rms {2} µm instead of {3} µm":
    "mit den Tabellen weicht die Werkzeugspitze über den Verfahrweg um bis zu {0} µm statt {1} µm ab, RMS {2} µm statt {3} µm",
  "What the tables cannot represent": "Was die Tabellen nicht abbilden können",
  "Nothing: all errors of the machine file are in the tables.":
    "Nichts: alle Fehler der Maschinendatei sind in den Tabellen.",
  "Each alone on the machine: the largest deviation of the tip that is left with the tables. Represented: none.":
    "Jeder für sich allein auf der Maschine: die größte Abweichung der Werkzeugspitze, die mit den Tabellen bleibt. Abgebildet: keine.",
  "Each alone on the machine: the largest deviation of the tip that is left with the tables. Represented: {0}.":
    "Jeder für sich allein auf der Maschine: die größte Abweichung der Werkzeugspitze, die mit den Tabellen bleibt. Abgebildet: {0}.",
  "Left with the tables": "Rest mit den Tabellen",
  "Errors left": "Verbleibende Fehler",
  error: "Fehler",
  "without tables, µm": "ohne Tabellen, µm",
  "with tables, µm": "mit Tabellen, µm",
  "compensate it instead": "stattdessen kompensieren durch",
  "Values to be added to {0}": "Zu {0} zu addierende Werte",
  "position of {0}": "Position von {0}",
  value: "Wert",
  "In least increments of {0}; the control adds them to the command.{1}":
    "In kleinsten Inkrementen von {0}; die Steuerung addiert sie zum Sollwert.{1}",
  " Whiskers: ± 2u of the error that is compensated, about 95 %.":
    " Unsicherheitsbalken: ± 2u des kompensierten Fehlers, etwa 95 %.",
  " The machine file states no uncertainty for this axis.":
    " Die Maschinendatei gibt für diese Achse keine Unsicherheit an.",
  "place of the map": "Stelle der Karte",
  wall: "Wanddicke",
  "least: {0} mm": "mindestens: {0} mm",
  "Remaining wall, as programmed and adapted": "Verbleibende Wanddicke, wie programmiert und angepasst",
  "as programmed": "wie programmiert",
  adapted: "angepasst",
  "Remaining wall, adapted": "Verbleibende Wanddicke, angepasst",
  "Places row by row around the part. Band: ± 2u of the wall, about 95 %. Below zero the wall is cut through.":
    "Stellen Reihe für Reihe um das Teil. Band: ± 2u der Wanddicke, etwa 95 %. Unter null ist die Wand durchgefräst.",
};

/** What the server says. */
export const server: Dictionary = {
  "SINUMERIK: $AA_ENC_COMP and $AN_CEC": "SINUMERIK: $AA_ENC_COMP und $AN_CEC",
  "FANUC: pitch error compensation and the grid of 3-D error compensation":
    "FANUC: Steigungsfehlerkompensation und Gitter der 3D-Fehlerkompensation",
  "HEIDENHAIN: .COM tables and KinematicsComp": "HEIDENHAIN: .COM-Tabellen und KinematicsComp",
  "ISG kernel: ISG_CSV and leadscrew lists": "ISG-Kernel: ISG_CSV und Spindelsteigungsfehlerlisten",
  "plain CSV: every axis on every linear axis": "einfache CSV: jede Achse auf jede Linearachse",
};
