(no O4711 anywhere)
G65 P4711 A1.
M30
