BEGIN PGM itself MM
CALL PGM itself
END PGM itself MM
