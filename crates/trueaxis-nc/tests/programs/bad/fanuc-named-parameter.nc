(names of parameters are of LinuxCNC)
#<a>=1
M30
