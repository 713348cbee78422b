BEGIN PGM a MM
Q1 = 5 / ( 2 - 2 )
END PGM a MM
