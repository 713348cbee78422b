(300 further work offsets)
G10 L20 P301 X1.
M30
