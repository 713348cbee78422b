import type { Dictionary } from "../index.ts";

export const texts: Dictionary = {
  "Open readings …": "Messwerte öffnen …",
  "{0} is not kept by this browser any more": "{0} ist in diesem Browser nicht mehr gespeichert",
  "Drop it here again.": "Hier erneut ablegen.",
  "Choose a campaign: it names the machine, the unknown errors and the readings of its instruments.":
    "Messkampagne wählen: Sie nennt die Maschine, die unbekannten Fehler und die Messwerte ihrer Messgeräte.",
  "Which instrument are the readings in {0} of? Choose it above.":
    "Von welchem Messgerät sind die Messwerte in {0}? Oben wählen.",
  "Fitting the errors to the readings, and checking them on readings held out …":
    "Fehler werden an die Messwerte angepasst und an zurückgehaltenen Messwerten geprüft …",
  "identifying from {0}": "Identifikation aus {0}",
  "A CSV of readings that is dropped anywhere on this page is used with this campaign.":
    "Eine CSV-Datei mit Messwerten, irgendwo auf dieser Seite abgelegt, wird mit dieser Messkampagne verwendet.",
  Campaign: "Messkampagne",
  "no readings": "keine Messwerte",
  "Readings of the campaign": "Messwerte der Messkampagne",
  "instead of the readings of": "statt der Messwerte von",
  "instrument, if there are several": "Messgerät, falls es mehrere gibt",
  "Instrument of the dropped readings": "Messgerät der abgelegten Messwerte",
  "of which instrument? …": "von welchem Messgerät? …",
  "Errors of the machine": "Fehler der Maschine",
  "Bars: value; whiskers: ± 2u, about 95 %. Grey: not significantly different from zero (|z| below 2).":
    "Balken: Wert; Unsicherheitsbalken: ± 2u, etwa 95 %. Grau: nicht signifikant von null verschieden (|z| unter 2).",
  "All unknowns are observable with these readings.": "Alle Unbekannten sind mit diesen Messwerten beobachtbar.",
  "Set-up": "Aufspannung",
  "Where balls, sockets and optics really sat: found along with the errors, of no interest afterwards.":
    "Wo Kugeln, Kugelpfannen und Optiken tatsächlich saßen: mit den Fehlern bestimmt, danach ohne Bedeutung.",
  "Correlation of what was identified": "Korrelation der identifizierten Größen",
  "not observable": "nicht beobachtbar",
  "No two unknowns are correlated by more than 0.9.": "Keine zwei Unbekannten sind mit mehr als 0.9 korreliert.",
  "The identified machine": "Die identifizierte Maschine",
  "No machine file is offered: these readings do not support one.":
    "Keine Maschinendatei verfügbar: Diese Messwerte reichen dafür nicht aus.",
  "Save the identified machine": "Identifizierte Maschine speichern",
  "{0} and {1}: {2} with the errors found here in place of its own, each with its uncertainty.":
    "{0} und {1}: {2} mit den hier gefundenen Fehlern anstelle der eigenen, jeder mit seiner Unsicherheit.",
  "{0}: {1} with the errors found here in place of its own, each with its uncertainty.":
    "{0}: {1} mit den hier gefundenen Fehlern anstelle der eigenen, jeder mit seiner Unsicherheit.",
  "The verdict is not good: something that these errors do not describe is left in the readings.":
    "Das Urteil ist nicht gut: In den Messwerten bleibt etwas übrig, das diese Fehler nicht beschreiben.",
  Identify: "Identifizieren",
  "no error of the machine is unknown": "kein Fehler der Maschine ist unbekannt",
  "{0} of 1 error found": "{0} von 1 Fehler bestimmt",
  "{0} of {1} errors found": "{0} von {1} Fehlern bestimmt",
  Good: "Gut",
  "Not good": "Nicht gut",
  "{0} in {1}: {2}. Rank {3}, condition {4}.": "{0}, {1}: {2}. Rang {3}, Konditionszahl {4}.",
  places: "Orte",
  "Not supported by the readings, and left out: {0}.": "Von den Messwerten nicht gestützt und weggelassen: {0}.",
  "without errors of the machine, set-up only": "ohne Fehler der Maschine, nur Messaufbau",
  "in sample": "an den verwendeten Messwerten",
  "held out, by place": "an zurückgehaltenen Orten",
  "repeatability, from repeated readings": "Wiederholpräzision, aus wiederholten Messwerten",
  "repeatability, as stated": "Wiederholpräzision, wie angegeben",
  "Root mean square of the residuals": "Quadratischer Mittelwert (RMS) der Restabweichungen",
  Bar: "Balken",
  "× noise": "× Rauschen",
  "not observable with these readings": "mit diesen Messwerten nicht beobachtbar",
  lengths: "Längen",
  angles: "Winkel",
  "All values": "Alle Werte",
  unknown: "Unbekannte",
  "standard uncertainty u": "Standardunsicherheit u",
  "z = value / u": "z = Wert / u",
  "Not separable": "Nicht trennbar",
  "1 combination that cannot be separated": "1 Kombination, die nicht trennbar ist",
  "{0} combinations that cannot be separated": "{0} Kombinationen, die nicht trennbar sind",
  "What would tell: ": "Trennbar durch: ",
  "{0} and {1} ({2}): their sum is better known than each":
    "{0} und {1} ({2}): ihre Summe ist besser bekannt als jeder Wert für sich",
  "{0} and {1} ({2}): their difference is better known than each":
    "{0} und {1} ({2}): ihre Differenz ist besser bekannt als jeder Wert für sich",
  Outliers: "Ausreißer",
  "studentised residual": "studentisierte Restabweichung",
  "Readings that move the result most": "Messwerte mit dem größten Einfluss auf das Ergebnis",
  leverage: "Hebelwirkung",
  "Cook’s distance": "Cook-Abstand",
  "Whether the residual follows the axes": "Ob die Restabweichung den Achsen folgt",
  "places by": "Orte nach",
  "share of it, held out, %": "Anteil daran, zurückgehalten, %",
  "Above zero: something of the machine is left that the model does not have.":
    "Über null: Es bleibt etwas von der Maschine übrig, das im Modell fehlt.",
  "None: no reading is farther off than {0} times its standard uncertainty.":
    "Keine: Kein Messwert liegt weiter ab als das {0}fache seiner Standardunsicherheit.",
  "From the front, left, above": "Von vorn, links, oben",
  "From above": "Von oben",
  "From the front": "Von vorn",
  "From the right": "Von rechts",
  "Magnification of the residuals": "Vergrößerung der Restabweichungen",
  "before: without the errors found": "vorher: ohne die gefundenen Fehler",
  "after: residual": "nachher: Restabweichung",
  "Residuals where the machine stood": "Restabweichungen an den Orten, an denen die Maschine stand",
  "Set-up of the instruments": "Messaufbau",
};

/** What the server says. */
export const server: Dictionary = {
  arrangement: "Anordnung der Achsen",
  approach: "Anfahrrichtung",
};
