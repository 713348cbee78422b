import type { Dictionary } from "../index.ts";

export const texts: Dictionary = {
  "Do the readings agree with the machine file?": "Stimmen die Messwerte mit der Maschinendatei überein?",
  Comparison: "Vergleich",
  "Choose a comparison: a TOML file with [compare] names the campaign, its readings and the decision rule.":
    "Vergleich wählen: eine TOML-Datei mit [compare] nennt die Messkampagne, ihre Messwerte und die Entscheidungsregel.",
  Calibrations: "Kalibrierungen",
  "Two calibrations: which errors have changed significantly?":
    "Zwei Kalibrierungen: Welche Fehler haben sich signifikant geändert?",
  "Older machine file": "Ältere Maschinendatei",
  "Choose two machine files of one machine, the older first.":
    "Zwei Maschinendateien einer Maschine wählen, die ältere zuerst.",
  History: "Verlauf",
  "How do the figures change over the calibrations, and when is a limit reached?":
    "Wie ändern sich die Kennwerte über die Kalibrierungen, und wann wird ein Grenzwert erreicht?",
  Folder: "Ordner",
  "Choose a folder with the machine files of one machine, one for each calibration, each with its date.":
    "Ordner mit den Maschinendateien einer Maschine wählen, eine je Kalibrierung, jede mit ihrem Datum.",
  Certificate: "Zertifikat",
  "What does a compensation leave at poses that were not used for it?":
    "Was lässt eine Kompensation in Posen übrig, die nicht für sie verwendet wurden?",
  Study: "Studie",
  "Choose the study of a certificate: it names the compensation, the determination and the readings that validate it.":
    "Studie eines Zertifikats wählen: sie nennt die Kompensation, die Bestimmung und die Messwerte zur Validierung.",
  Laser: "Laser",
  "What does a laser read before and after a compensation?": "Was zeigt ein Laser vor und nach einer Kompensation an?",
  "Choose a campaign of lasers, such as examples/07_verify/laser-before-after-x.toml.":
    "Messkampagne mit Lasern wählen, zum Beispiel examples/07_verify/laser-before-after-x.toml.",
  Part: "Teil",
  "Is a measured part within its tolerances, and was the prediction right?":
    "Liegt ein gemessenes Teil innerhalb seiner Toleranzen, und war die Vorhersage richtig?",
  "Measured part": "Gemessenes Teil",
  "Choose a file with [measured] or [cmm]: the test piece, its points or figures, the decision rule.":
    "Datei mit [measured] oder [cmm] wählen: das Prüfwerkstück, seine Punkte oder Kennwerte, die Entscheidungsregel.",
  "What is verified": "Was geprüft wird",
  "Newer machine file": "Neuere Maschinendatei",
  "Folder …": "Ordner …",
  "Limits of figures, separated by semicolons": "Grenzwerte von Kennwerten, durch Semikolon getrennt",
  Limits: "Grenzwerte",
  "Comparing …": "Vergleich läuft …",
  "verifying {0}": "{0} wird geprüft",
  "{0}, channel {1}": "{0}, Kanal {1}",
  "Measured − expected, with U (k = {0})": "Gemessen − erwartet, mit U (k = {0})",
  "line of the readings": "Zeile der Messwerte",
  "Change of each error, {0}": "Änderung jedes Fehlers, {0}",
  "changed: {0}{1}": "geändert: {0}{1}",
  "New − old where the change is clearest; whiskers ± 2u, about 95 %. Red: changed significantly; amber: perhaps; grey: no.":
    "Neu − alt, wo die Änderung am deutlichsten ist; Unsicherheitsbalken ± 2u, etwa 95 %. Rot: signifikant geändert; gelb: vielleicht; grau: nein.",
  "What the change of each error alone does to the tip, largest":
    "Größte Wirkung der Änderung jedes einzelnen Fehlers auf die Werkzeugspitze",
  "lower control limit": "untere Eingriffsgrenze",
  "upper control limit": "obere Eingriffsgrenze",
  "limit {0} {1}": "Grenzwert {0} {1}",
  "{0} – needs attention": "{0} – zu beachten",
  year: "Jahr",
  "Whiskers: ± 2u, about 95 %.{0}": "Unsicherheitsbalken: ± 2u, etwa 95 %.{0}",
  " The first {0} of {1} figures.": " Die ersten {0} von {1} Kennwerten.",
  "predicted to be within (95 %)": "vorhergesagt innerhalb (95 %)",
  "limit {0} µm": "Grenzwert {0} µm",
  "pose of the validation": "Pose der Validierung",
  "deviation of the tip": "Abweichung der Werkzeugspitze",
  "Deviation of the tip, without and with the compensation":
    "Abweichung der Werkzeugspitze, ohne und mit der Kompensation",
  "Deviation of the tip with the compensation": "Abweichung der Werkzeugspitze mit der Kompensation",
  "Whiskers: U of one coordinate of a reading, {0} µm (k = {1}).":
    "Unsicherheitsbalken: U einer Koordinate eines Messwerts, {0} µm (k = {1}).",
  "compensation: none": "Kompensation: keine",
  "compensation: machine": "Kompensation: Maschine",
  "compensation: comprehensive": "Kompensation: Maschine − Werkstück",
  "{0}: mean deviation at each target": "{0}: mittlere Abweichung je Zielposition",
  "target on {0}": "Zielposition auf {0}",
  "not predicted": "nicht vorhergesagt",
  "Measured, mean of the parts": "Gemessen, Mittelwert der Teile",
  Predicted: "Vorhergesagt",
  "Whiskers: ± 2u, about 95 %; both on one scale.": "Unsicherheitsbalken: ± 2u, etwa 95 %; beide im gleichen Maßstab.",
  "Points of part 1, normal deviation in each section":
    "Punkte von Teil 1, Abweichung in Normalenrichtung in jedem Schnitt",
  "deviation; above 0: material left": "Abweichung; über 0: Material steht noch",
};

/** What the server says. */
export const server: Dictionary = {
  "roundness eq18": "Rundheit Gl. 18",
  "angularity eq19": "Neigung Gl. 19",
  "coaxiality eq20": "Koaxialität Gl. 20",
  "coaxiality diameter": "Koaxialität Gl. 20, Durchmesser",
  "roundness lsc": "Rundheit LSC",
  "roundness mzc": "Rundheit MZC",
  "roundness mic": "Rundheit MIC",
  "roundness mcc": "Rundheit MCC",
  "coaxiality lsc": "Koaxialität LSC",
  "angularity zone": "Neigung, Zone",
  "volumetric max": "größte räumliche Abweichung",
};
