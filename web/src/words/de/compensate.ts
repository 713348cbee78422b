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
  "the work offset, or the tool length and its direction":
    "die Nullpunktverschiebung oder die Werkzeuglänge und ihre Richtung",
  "the zero of the axis": "den Nullpunkt der Achse",
  "the control's kinematic parameters (rotary centres and tilts), or the NC program":
    "die Kinematikparameter der Steuerung (Drehzentren und Neigungen) oder das NC-Programm",
  "the NC program; a volumetric compensation for the position alone":
    "das NC-Programm; für die Position allein auch eine volumetrische Kompensation",
  "a control with cross tables, or the NC program": "eine Steuerung mit Kreuztabellen oder das NC-Programm",
  "the NC program": "das NC-Programm",
  "detection unit 0.1 um and 0.0001 deg (increment system IS-C), magnification 1; the reference position is machine position 0":
    "Erfassungseinheit 0.1 um und 0.0001 deg (Inkrementsystem IS-C), Vergrößerungsfaktor 1; die Referenzposition ist die Maschinenposition 0",
  "N01850 is what is added at the reference position; with an absolute encoder shift the reference position by it instead":
    "N01850 ist das, was an der Referenzposition addiert wird; bei einem absoluten Messsystem stattdessen die Referenzposition darum verschieben",
  "check the sign with one table and a dial before all are loaded; power off and on, then reference return, before it acts":
    "das Vorzeichen mit einer Tabelle und einer Messuhr prüfen, bevor alle geladen werden; wirksam erst nach Aus- und Einschalten und Referenzpunktfahrt",
  "compare PITCH.TXT and PARAM.TXT with files that the control has punched: lines and parameter numbers are those of 16i manuals and of backups of 31i controls, N10000Q0 is not proved":
    "PITCH.TXT und PARAM.TXT mit Dateien vergleichen, die die Steuerung ausgegeben hat: Zeilen und Parameternummern sind die der 16i-Handbücher und der Sicherungen von 31i-Steuerungen, N10000Q0 ist nicht nachgewiesen",
  "GRID3D.CSV lists the points of 3-D error compensation (option); its file form is not public: enter the grid with the parameters of the function":
    "GRID3D.CSV enthält die Punkte der 3D-Fehlerkompensation (Option); deren Dateiformat ist nicht öffentlich: das Gitter mit den Parametern der Funktion eingeben",
  "straightness compensation is off: the grid contains it":
    "die Geradheitskompensation ist aus: das Gitter enthält sie",
  "kinematics.csv: the centres belong into the parameters of the 5-axis machine (19700 ff.); their directions stay nominal":
    "kinematics.csv: die Drehzentren gehören in die Parameter der 5-Achs-Maschine (19700 ff.); ihre Richtungen bleiben nominell",
  "head and columns of .COM are those of a TNC 640 as a program of practice writes them; .CMA and COMPTAB have no public form: enter their rows with the table editor of the control":
    "Kopf und Spalten von .COM sind die einer TNC 640, wie ein Programm aus der Praxis sie schreibt; .CMA und COMPTAB haben kein öffentliches Format: ihre Zeilen mit dem Tabelleneditor der Steuerung eingeben",
  "BACKLASH holds the values of the negative direction, as in the manual of the MANUALplus 620":
    "BACKLASH enthält die Werte der negativen Richtung, wie im Handbuch der MANUALplus 620",
  "values are actual minus nominal, mm and deg; check the sign with one table and a dial before all are switched on":
    "die Werte sind Ist minus Soll, mm und deg; das Vorzeichen mit einer Tabelle und einer Messuhr prüfen, bevor alle eingeschaltet werden",
  "COMPTAB.TXT has the rows that stand in front of each MachAxis of the kinematics table, which has to be in the form with KEY, AXIS, COORD; KinematicsComp is an option":
    "COMPTAB.TXT enthält die Zeilen, die vor jeder MachAxis der Kinematiktabelle stehen; diese muss die Form mit KEY, AXIS, COORD haben; KinematicsComp ist eine Option",
  "positions are machine positions; location errors stand in the functions of their axis":
    "Positionen sind Maschinenpositionen; Lagefehler stehen in den Funktionen ihrer Achse",
  "the two lines of hochlauf.lis stand as comments at the head of vol_comp_0.lis; logical axis numbers there are 1, 2, … : put in those of the machine":
    "die beiden Zeilen für hochlauf.lis stehen als Kommentare am Anfang von vol_comp_0.lis; logische Achsnummern sind dort 1, 2, … : die der Maschine einsetzen",
  "leadscrew lists: kopf.achs_nr is to be the logical axis number; lr_param.ssfk 1; no other backlash compensation":
    "Spindelsteigungsfehlerlisten: kopf.achs_nr muss die logische Achsnummer sein; lr_param.ssfk 1; keine andere Umkehrspielkompensation",
  "check the sign with one axis and a dial before all is switched on: if the tip moves the other way, name the axis in `negate`":
    "das Vorzeichen mit einer Achse und einer Messuhr prüfen, bevor alles eingeschaltet wird: bewegt sich die Werkzeugspitze in die andere Richtung, die Achse in `negate` nennen",
  "location errors stand in the functions of their axis, so X0X … C0C are not to be entered a second time":
    "Lagefehler stehen in den Funktionen ihrer Achse, X0X … C0C sind also nicht noch einmal einzugeben",
  "COMP_FILE takes the place of BACKLASH of the joint": "COMP_FILE tritt an die Stelle von BACKLASH des Gelenks",
  "positions are machine coordinates after homing; a rotary joint that wraps is compensated within its table only":
    "Positionen sind Maschinenkoordinaten nach der Referenzfahrt; eine endlos drehende Rundachse wird nur innerhalb ihrer Tabelle kompensiert",
  "kinematics.hal, where there is one, after the module of KINEMATICS is loaded and instead of the setp lines of its centres; the part zero is set with it on":
    "kinematics.hal, wenn vorhanden, nach dem Laden des Moduls von KINEMATICS und anstelle der setp-Zeilen seiner Drehzentren; der Werkstücknullpunkt wird gesetzt, während sie wirksam ist",
  "MD38000 and MD18342 at least the number of points; they re-format the memory: save the data first":
    "MD38000 und MD18342 mindestens gleich der Anzahl der Punkte; sie formatieren den Speicher neu: vorher die Daten sichern",
  "before loading: MD32700 $MA_ENC_COMP_ENABLE and MD32710 $MA_CEC_ENABLE 0, after it 1; SD41300 $SN_CEC_TABLE_ENABLE[t] = 1":
    "vor dem Laden: MD32700 $MA_ENC_COMP_ENABLE und MD32710 $MA_CEC_ENABLE 0, danach 1; SD41300 $SN_CEC_TABLE_ENABLE[t] = 1",
  "MD10200 and MD10210 at least 10 000 increments per mm and degree; MD32720 $MA_CEC_MAX_SUM above the largest value":
    "MD10200 und MD10210 mindestens 10 000 Inkremente je mm und Grad; MD32720 $MA_CEC_MAX_SUM über dem größten Wert",
  "TEMP_COMP.SPF (with --temperature): SD43900, SD43910, SD43920 for those temperatures; MD32750 $MA_TEMP_COMP_TYPE = 3; the PLC is to write them as the temperatures change":
    "TEMP_COMP.SPF (mit --temperature): SD43900, SD43910, SD43920 für diese Temperaturen; MD32750 $MA_TEMP_COMP_TYPE = 3; die PLC muss sie schreiben, wenn sich die Temperaturen ändern",
  "TOOLCARRIER.SPF adds nothing at zero angles, whatever its vectors are: set the part zero with the vectors in force, where `zero set` counts":
    "TOOLCARRIER.SPF addiert bei Winkeln null nichts, gleich welche Vektoren es hat: den Werkstücknullpunkt mit wirksamen Vektoren setzen, es gilt die Zeile `zero set`",
  "TOOLCARRIER.SPF: the vectors of the rotary axes, for CYCLE800 and for TRAORI of type 72; for types 24, 40 and 56 they are MD24500 ff. (Commissioning Manual SINUMERIK Operate)":
    "TOOLCARRIER.SPF: die Vektoren der Rundachsen, für CYCLE800 und für TRAORI vom Typ 72; für die Typen 24, 40 und 56 sind es MD24500 ff. (Inbetriebnahmehandbuch SINUMERIK Operate)",
  "check the sign with one table and a dial: switched on at the place that is named, the axis must move by what the table adds; if it moves the other way, do not use the tables":
    "das Vorzeichen mit einer Tabelle und einer Messuhr prüfen: an der genannten Stelle eingeschaltet muss sich die Achse um das bewegen, was die Tabelle addiert; bewegt sie sich in die andere Richtung, die Tabellen nicht verwenden",
  PROVED: "NACHGEWIESEN",
  "NOT PROVED": "NICHT NACHGEWIESEN",
  GOOD: "GUT",
  "NOT TO BE CUT": "NICHT FRÄSEN",
  Changes: "Änderungen",
  "Largest correction of each axis": "Größte Korrektur jeder Achse",
  "Blocks with the largest residual deviation": "Sätze mit der größten Restabweichung",
  "Convention check": "Prüfung der Vorzeichen",
  "blocks that move the tool": "Sätze, die das Werkzeug bewegen",
  "of these divided into several": "davon in mehrere aufgeteilt",
  "blocks written for them": "dafür geschriebene Sätze",
  "circles that became lines": "Kreise, die zu Geraden wurden",
  "words added": "hinzugefügte Wörter",
  "computed words corrected": "korrigierte berechnete Wörter",
  "feeds changed where only rotary axes turn": "geänderte Vorschübe, wo sich nur Rundachsen drehen",
  correction: "Korrektur",
  "tip before, µm": "Werkzeugspitze vorher, µm",
  "tip after, µm": "Werkzeugspitze nachher, µm",
  "tool axis before, µrad": "Werkzeugachse vorher, µrad",
  "tool axis after, µrad": "Werkzeugachse nachher, µrad",
  "tip, µm": "Werkzeugspitze, µm",
  "tool axis, µrad": "Werkzeugachse, µrad",
  "no correction": "keine Korrektur",
  "all signs wrong": "alle Vorzeichen falsch",
  "What would be left at the block with the largest correction without any, and if the control took it with a wrong sign: a wrong sign makes it about twice as bad as no correction. Try one pose on the machine before the first part.":
    "Was am Satz mit der größten Korrektur ohne Korrektur bliebe, und wenn die Steuerung sie mit falschem Vorzeichen nähme: ein falsches Vorzeichen ist etwa doppelt so schlecht wie keine Korrektur. Vor dem ersten Teil eine Pose an der Maschine prüfen.",
  geometric: "geometrisch",
  "+ scale": "+ Maßstab",
  "+ struct.": "+ Struktur",
  "= machine": "= Maschine",
  "- workpiece": "- Werkstück",
  "= part": "= Teil",
  remainder: "Rest",
  "value ↑": "Wert ↑",
  "value ↓": "Wert ↓",
  "Why it must not be cut": "Warum nicht gefräst werden darf",
  finding: "Befund",
  "worst at": "schlechteste Stelle",
  message: "Meldung",
  "Remaining wall": "Verbleibende Wanddicke",
  "wall, mm": "Wanddicke, mm",
  least: "kleinste",
  most: "größte",
  "cut through": "durchgefräst",
  "Position of the blank": "Lage des Rohteils",
  "± standard uncertainty": "± Standardunsicherheit",
  "shift, µm": "Verschiebung, µm",
  "turn, µrad": "Drehung, µrad",
  "Form of the blank": "Form des Rohteils",
  "their standard uncertainty": "deren Standardunsicherheit",
  "each point predicted by all others": "jeder Punkt aus allen anderen vorhergesagt",
  "outlier: point": "Ausreißer: Punkt",
  "off the others, µm": "Abstand zu den anderen, µm",
};
