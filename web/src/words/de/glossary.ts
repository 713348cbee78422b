import type { Dictionary } from "../index.ts";

export const texts: Dictionary = {
  "Name of the error": "Name des Fehlers",
  "Workpiece w": "Werkstück w",
  "Tool t": "Werkzeug t",
  "Axis {0}": "Achse {0}",
  What: "Bedeutung",
  Kind: "Art",
  Unit: "Einheit",
  Sign: "Vorzeichen",
  "actual − nominal. ": "Ist − Soll. ",
  "At the tool": "Am Werkzeug",
  "Seen by": "Erfassbar mit",
  "Dashed: nominal. Filled: actual. The directions are those of the machine axes; ISO 230-1, docs/conventions.md.":
    "Gestrichelt: Soll. Gefüllt: Ist. Die Richtungen sind die der Maschinenachsen; ISO 230-1, docs/conventions.md.",
  "tilt about {0} of {1} (rotation about {2})": "Kippen von {1} um {0} (Drehung um {2})",
  "yaw of {0} (rotation about {1})": "Gieren von {0} (Drehung um {1})",
  "pitch of {0} (rotation about {1})": "Nicken von {0} (Drehung um {1})",
  "positioning error of {0}": "Positionierfehler von {0}",
  "How far {0} is from where it was commanded, along itself.":
    "Wie weit {0} in der eigenen Richtung von der Sollposition entfernt ist.",
  "straightness error of {0} in {1}": "Geradheitsfehler von {0} in {1}",
  "How far {0} leaves its straight line in {1} while it travels.":
    "Wie weit {0} beim Verfahren in {1} von der Geraden abweicht.",
  "roll of {0} (rotation about itself)": "Rollen von {0} (Drehung um sich selbst)",
  "How the carriage of {0} turns about its direction of travel.":
    "Wie sich der Schlitten von {0} um seine Verfahrrichtung dreht.",
  "How the carriage of {0} turns about {1} while it travels. What is far from the guideway moves by the distance times the angle (Abbe).":
    "Wie sich der Schlitten von {0} beim Verfahren um {1} dreht. Was weit von der Führung entfernt ist, verschiebt sich um Abstand mal Winkel (Abbe).",
  "angular positioning error of {0}": "Winkelpositionierfehler von {0}",
  "How far {0} has turned from where it was commanded.": "Um wie viel {0} gegenüber dem Sollwinkel verdreht ist.",
  "tilt error motion of {0} about {1}": "Kippfehlerbewegung von {0} um {1}",
  "How the axis of rotation of {0} tilts about {1} during a turn.":
    "Wie sich die Drehachse von {0} während einer Umdrehung um {1} neigt.",
  "axial error motion of {0}": "axiale Fehlerbewegung von {0}",
  "How {0} moves along its axis of rotation during a turn.":
    "Wie sich {0} während einer Umdrehung längs der Drehachse bewegt.",
  "radial error motion of {0} in {1}": "radiale Fehlerbewegung von {0} in {1}",
  "How the centre of {0} moves in {1} during a turn.":
    "Wie sich der Mittelpunkt von {0} während einer Umdrehung in {1} bewegt.",
  "zero position error of {0}": "Nullpunktfehler von {0}",
  "How far the zero of {0} is from its place.": "Wie weit der Nullpunkt von {0} von seinem Ort entfernt ist.",
  "position error of {0} in {1}": "Positionsfehler von {0} in {1}",
  "How far the whole guideway of {0} is from its place, in {1}.":
    "Wie weit die ganze Führung von {0} in {1} von ihrem Ort entfernt ist.",
  "orientation error of {0} about itself": "Orientierungsfehler von {0} um sich selbst",
  "How the body that {0} carries is turned about the direction of travel.":
    "Wie der von {0} getragene Körper um die Verfahrrichtung verdreht ist.",
  "squareness error of {0} to {1} (orientation about {2})":
    "Rechtwinkligkeitsfehler von {0} zu {1} (Orientierung um {2})",
  "How far the angle between {0} and {1} is from 90°.": "Um wie viel der Winkel zwischen {0} und {1} von 90° abweicht.",
  "position error of {0} along its axis": "Positionsfehler von {0} längs der Drehachse",
  "How far the table or head of {0} is from its place along the axis of rotation.":
    "Wie weit Tisch oder Kopf von {0} längs der Drehachse von seinem Ort entfernt ist.",
  "position error of the axis of {0} in {1}": "Positionsfehler der Drehachse von {0} in {1}",
  "How far the axis of rotation of {0} is from its place, in {1}.":
    "Wie weit die Drehachse von {0} in {1} von ihrem Ort entfernt ist.",
  "zero angle error of {0}": "Nullwinkelfehler von {0}",
  "How far the zero of {0} is turned.": "Um wie viel der Nullpunkt von {0} verdreht ist.",
  "orientation error of {0} about {1} (squareness to {2})":
    "Orientierungsfehler von {0} um {1} (Rechtwinkligkeit zu {2})",
  "How the axis of rotation of {0} leans, about {1}; its angle to {2} is not 90°.":
    "Wie die Drehachse von {0} um {1} geneigt ist; ihr Winkel zu {2} ist nicht 90°.",
  "position of the workpiece in {0}": "Position des Werkstücks in {0}",
  "How the workpiece is mounted: its place differs from the nominal one.":
    "Wie das Werkstück aufgespannt ist: Sein Ort weicht vom Sollort ab.",
  "orientation of the workpiece about {0}": "Orientierung des Werkstücks um {0}",
  "How the workpiece is mounted: its direction differs from the nominal one.":
    "Wie das Werkstück aufgespannt ist: Seine Richtung weicht von der Sollrichtung ab.",
  "position of the tool holder in {0}": "Position des Werkzeughalters in {0}",
  "How the tool holder is mounted: its place differs from the nominal one.":
    "Wie der Werkzeughalter sitzt: Sein Ort weicht vom Sollort ab.",
  "orientation of the tool holder about {0}": "Orientierung des Werkzeughalters um {0}",
  "How the tool holder is mounted: its direction differs from the nominal one.":
    "Wie der Werkzeughalter sitzt: Seine Richtung weicht von der Sollrichtung ab.",
  "{0} > 0: the workpiece is displaced towards +{1}.": "{0} > 0: Das Werkstück ist nach +{1} verschoben.",
  "{0} > 0: the tool holder is displaced towards +{1}.": "{0} > 0: Der Werkzeughalter ist nach +{1} verschoben.",
  "{0} > 0: the body of {1} is displaced towards +{2}.": "{0} > 0: Der Körper von {1} ist nach +{2} verschoben.",
  "{0} > 0: a rotation in the positive sense about {1}, from +{2} towards +{3}.":
    "{0} > 0: eine Drehung im positiven Sinn um {1}, von +{2} nach +{3}.",
  "The + direction of {0}": "Die Plusrichtung von {0}",
  "The + direction of the axis of {0}": "Die Plusrichtung der Drehachse von {0}",
  "{0} leans towards +{1}: its angle to +{2} is smaller than 90°.":
    "{0} neigt sich nach +{1}: Ihr Winkel zu +{2} ist kleiner als 90°.",
  "{0} leans towards −{1}: its angle to +{2} is larger than 90°.":
    "{0} neigt sich nach −{1}: Ihr Winkel zu +{2} ist größer als 90°.",
  "The tool deviates by the same amount.": "Das Werkzeug weicht um denselben Betrag ab.",
  "The workpiece is displaced: the tool deviates by −{0} in it.":
    "Das Werkstück ist verschoben: Das Werkzeug weicht im Werkstück um −{0} ab.",
  "If {0} carries the tool, the tool deviates by {1} with its levers; if {2} carries the workpiece, by −{3} in the workpiece, whatever the sense of the axis.":
    "Trägt {0} das Werkzeug, weicht das Werkzeug mit den jeweiligen Hebelarmen um {1} ab; trägt {2} das Werkstück, im Werkstück um −{3}, unabhängig vom Richtungssinn der Achse.",
  "Setting the part up: touch probe on the datum surfaces.":
    "Beim Einrichten des Teils: Messtaster an den Bezugsflächen.",
  "Tool setting probe or presetter; a mandrel and dial gauges at two heights.":
    "Werkzeugmesstaster oder Voreinstellgerät; Prüfdorn und Messuhren in zwei Höhen.",
  "Laser interferometer, step gauge, comparator scale; a ball bar sees its scale. Tests of ISO 230-2.":
    "Laserinterferometer, Stufenendmaß, Vergleichsmaßstab; ein Ballbar erfasst den Maßstabsfehler. Prüfungen nach ISO 230-2.",
  "Straightedge and dial gauge (reversal), straightness interferometer, alignment laser, taut wire; grid encoder.":
    "Lineal und Messuhr (Umschlagmessung), Geradheitsinterferometer, Fluchtungslaser, gespannter Draht; Kreuzgitter-Messgerät.",
  "Two straightness runs at different offsets; multi-axis laser.":
    "Zwei Geradheitsmessungen mit verschiedenem Versatz; Mehrachsen-Laser.",
  "Electronic levels, or two straightness runs at different offsets; multi-axis laser.":
    "Elektronische Neigungswaagen oder zwei Geradheitsmessungen mit verschiedenem Versatz; Mehrachsen-Laser.",
  "Angular interferometer, autocollimator; a level does not see rotations about the vertical.":
    "Winkelinterferometer, Autokollimator; eine Neigungswaage erfasst keine Drehung um die Senkrechte.",
  "Angular interferometer, autocollimator, electronic levels.":
    "Winkelinterferometer, Autokollimator, elektronische Neigungswaagen.",
  "Polygon and autocollimator, rotary laser calibrator, reference index table. Tests of ISO 230-7 and ISO 230-2.":
    "Spiegelpolygon und Autokollimator, Laser-Drehwinkelkalibrator, Referenzteiltisch. Prüfungen nach ISO 230-7 und ISO 230-2.",
  "Mandrel or two spheres at different heights with displacement sensors (ISO 230-7); R-test with two ball heights.":
    "Prüfdorn oder zwei Kugeln in verschiedenen Höhen mit Wegsensoren (ISO 230-7); R-Test mit zwei Kugelhöhen.",
  "Sphere or mandrel with displacement sensors (ISO 230-7), R-test, ball bar on the turning table.":
    "Kugel oder Prüfdorn mit Wegsensoren (ISO 230-7), R-Test, Ballbar auf dem drehenden Tisch.",
  "Is set to zero by the reference of the axis; seen only against other axes, by a touch probe or an R-test.":
    "Wird durch den Referenzpunkt der Achse auf null gesetzt; nur gegenüber anderen Achsen erfassbar, mit Messtaster oder R-Test.",
  "Level or dial gauge across the carriage; seen only through the bodies it carries.":
    "Neigungswaage oder Messuhr quer zum Schlitten; nur über die getragenen Körper erfassbar.",
  "Square and dial gauge, ball bar in the plane of both axes (ISO 230-4), diagonals (ISO 230-6), straightness interferometer with optical square, grid encoder.":
    "Winkelnormal und Messuhr, Ballbar in der Ebene beider Achsen (ISO 230-4), Diagonalen (ISO 230-6), Geradheitsinterferometer mit Pentaprisma, Kreuzgitter-Messgerät.",
  "R-test, touch probe on a sphere over turns of the table, ball bar with the axis turning (ISO 10791-6), programs of the control for its rotary centres.":
    "R-Test, Messtaster an einer Kugel über Drehungen des Tisches, Ballbar bei drehender Achse (ISO 10791-6), Zyklen der Steuerung für die Drehzentren.",
  "Dial gauge along the edge of the table, touch probe on a reference surface.":
    "Messuhr längs der Tischkante, Messtaster an einer Referenzfläche.",
  "Ball bar with the axis turning, R-test or sphere at two heights, dial gauge on a mandrel or on the face of the table.":
    "Ballbar bei drehender Achse, R-Test oder Kugel in zwei Höhen, Messuhr am Prüfdorn oder an der Tischfläche.",
  "Location error (the 0 in the name): one number, the same at every position.":
    "Lagefehler (die 0 im Namen): eine Zahl, an jeder Position dieselbe.",
  "Error motion: a function of the commanded angle of {0}.": "Fehlerbewegung: eine Funktion des Sollwinkels von {0}.",
  "Error motion: a function of the commanded position of {0}.":
    "Fehlerbewegung: eine Funktion der Sollposition von {0}.",
  "{0} displacement in {1}": "{0}: Verschiebung in {1}",
  "{0} rotation about {1}": "{0}: Drehung um {1}",
  "w of the workpiece": "w: Werkstück",
  "t of the tool": "t: Werkzeug",
  "{0} of axis {1}": "{0}: Achse {1}",
  "E error": "E: Fehler",
  "0 location": "0: Lagefehler",
};
