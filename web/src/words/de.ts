/** The frame of the page in German. */

import type { Words } from "./en.ts";

export const de: Words = {
  name: "Deutsch",
  tabs: {
    start: "Start",
    describe: "Beschreiben",
    simulate: "Simulieren",
    predict: "Vorhersagen",
    plan: "Planen",
    measure: "Messen",
    identify: "Identifizieren",
    compensate: "Kompensieren",
    verify: "Prüfen",
    standards: "Normen",
    live: "Live",
    report: "Bericht",
  },
  verbs: "Tätigkeiten",
  language: "Sprache",
  theme: "Hell oder dunkel",
  themes: { auto: "System", light: "Hell", dark: "Dunkel" },
  progress: "Fortschritt",
  connecting: "Verbindung wird hergestellt …",
  lost: "keine Verbindung – neuer Versuch",
  close: "Schließen",
  close_message: "Diese Meldung schließen",
  more: (n) => `und ${n} weitere`,
  changed_on_disk: (path) => `${path} hat sich auf der Platte geändert`,
  saved_elsewhere: (path) => `${path} wurde in einem anderen Fenster gespeichert`,
  unsaved: (n) => (n === 1 ? "1 Datei nicht gespeichert" : `${n} Dateien nicht gespeichert`),
  keys: "Tasten",
  single_keys: "Tasten ohne Strg wirken auf die Seite",
  key_groups: [
    {
      title: "Überall",
      keys: [
        ["?", "diese Liste"],
        ["E", "Namen der Fehler, jeder mit einer Zeichnung"],
        ["Tab, Umschalt+Tab", "zum nächsten und zum vorigen Bedienelement"],
        ["← → Pos1 Ende", "auf den Reitern und den Seiten eines Reiters: wechseln; Enter öffnet"],
        ["← → ↑ ↓", "auf dem Trenner: Größe des Bildes ändern"],
        ["Esc", "Dialog schließen"],
      ],
    },
    {
      title: "Simulieren",
      keys: [
        ["Leertaste", "abspielen, anhalten"],
        ["← →", "einen Satz zurück, einen Satz vor"],
        ["Pos1, Ende", "zum Anfang, zum Ende"],
        ["G", "zu einer Zeile gehen"],
        ["/", "im Programm suchen; Enter die nächste Stelle, Umschalt+Enter die vorige"],
        ["N, Umschalt+N", "nächste und vorige Beanstandung: Kollisionen, Endlagen; wo keine ist, Hinweise"],
        ["↑ ↓ Bild auf, Bild ab", "im Programmtext: Marke bewegen; Enter geht zu ihrer Zeile"],
      ],
    },
    {
      title: "Beschreiben",
      keys: [
        ["Strg+S", "Maschinendatei speichern"],
        ["Strg+Z, Strg+Umschalt+Z", "rückgängig, wiederholen"],
        ["Enter, Esc", "im Feld eines Fehlers: übernehmen, wiederherstellen"],
      ],
    },
    {
      title: "Maschine in drei Dimensionen",
      keys: [
        ["← → ↑ ↓", "drehen; mit Umschalt verschieben"],
        ["+ −", "näher, weiter weg"],
        ["0 1 2 3", "Ansichten: isometrisch, längs X, Y, Z"],
        ["4", "alles zeigen"],
        ["5", "Parallelprojektion"],
      ],
    },
    {
      title: "Diagramme",
      keys: [
        ["← →", "auf einer Kurve: Punkt für Punkt ablesen"],
        ["← → ↑ ↓", "auf einer Matrix: Feld für Feld ablesen"],
        ["Enter", "auf einer Kurve über der Zeit: zu dieser Zeit gehen; auf Balken, Bohrung, Zeile: auswählen"],
        ["+ −", "auf einer Kurve über der Zeit: näher heran, alles zeigen"],
      ],
    },
  ],
};
