/** The controls whose programs are read and written, by their names on the command line: every list of the page has all of them. */
export const CONTROLS: readonly [string, string][] = [
  ["sinumerik", "SINUMERIK"],
  ["fanuc", "FANUC"],
  ["haas", "Haas"],
  ["linuxcnc", "LinuxCNC"],
  ["heidenhain", "HEIDENHAIN"],
];
