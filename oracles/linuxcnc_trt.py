"""LinuxCNC's own inverse kinematics of tilting rotary tables -> crates/trueaxis/tests/data/linuxcnc-trt.csv

usage: python3 oracles/linuxcnc_trt.py TRTFUNCS_2_9_C TRTFUNCS_2_10_C
tool: LinuxCNC, src/emc/kinematics/trtfuncs.c (xyzacKinematicsInverse, xyzbcKinematicsInverse), compiled with gcc against
      the stub of its HAL below: v2.9.10, commit 86cdca76fa2a36274c432caa21952b23c267989a, for its usual directions
      (conventional 0); 2.10.0~pre1, commit 5c41560ebbc3a40f84a5547bc6f7c5cd9278ba6b, for the conventional ones (1).
      In 2.10.0~pre1 the inverse of the BC table leaves the sense out of its offsets: with the usual directions it contradicts
      its own forward kinematics by up to 341 mm here; so 2.9 is taken for them. Each answer is checked by its own forward.
Nothing of LinuxCNC is kept here: the numbers alone are.
"""
import os
import random
import subprocess
import sys
import tempfile

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
OUT = os.path.join(ROOT, "crates", "trueaxis", "tests", "data", "linuxcnc-trt.csv")
SOURCES = sys.argv[1:3]  # conventional 0, 1

STUBS = {
    "rtapi_math.h": "#include <math.h>\n",
    "rtapi_string.h": "#include <string.h>\n",
    "rtapi_ctype.h": "#include <ctype.h>\n",
    "hal.h": """
#include <stdlib.h>
#include <stdarg.h>
typedef double rtapi_real; typedef double hal_real_t; typedef int hal_bool_t;
#define HAL_IN 0
#define RTAPI_MSG_ERR 0
#define rtapi_print_msg(...)
#define rtapi_print(...)
#define hal_malloc malloc
#define hal_get_real(x) (x)
#define hal_get_bool(x) (x)
#define hal_float_t double
#define hal_pin_float_newf(dir, pin, id, ...) ((*(pin) = calloc(1, 8)), 0)
#define hal_pin_new_real(id, dir, pin, value, ...) ((*(pin) = (value)), 0)
#define hal_pin_new_bool(id, dir, pin, value, ...) ((*(pin) = (value)), 0)
""",
    "emcmotcfg.h": "#ifndef EMCMOT_MAX_JOINTS\n#define EMCMOT_MAX_JOINTS 16\n#endif\n",
    "motion.h": '#include "emcmotcfg.h"\n#include "hal.h"\n#include "kinematics.h"\n',
    "kinematics.h": """
#pragma once
#include <string.h>
#include "emcmotcfg.h"
#define TO_RAD (3.14159265358979323846 / 180)
typedef struct { double x, y, z; } PmCartesian;
typedef struct { PmCartesian tran; double a, b, c, u, v, w; } EmcPose;
typedef unsigned long KINEMATICS_FORWARD_FLAGS, KINEMATICS_INVERSE_FLAGS;
typedef struct { char *sparm, *kinsname, *halprefix, *required_coordinates; int max_joints, allow_duplicates; } kparms;
static int map_coordinates_to_jnumbers(const char *s, int n, int d, int *m) {
    for (int i = 0; i < EMCMOT_MAX_JOINTS; i++) m[i] = -1;
    for (int i = 0; s[i]; i++) m[i] = (int)(strchr("XYZABCUVW", s[i]) - "XYZABCUVW");
    return 0;
}
static int position_to_mapped_joints(int n, const EmcPose *p, double *j);
""",
    "main.c": """
#include <stdio.h>
#include "trtfuncs.c"
#ifdef POINTERS
#define PIN(name) *haldata->name
#else
#define PIN(name) haldata->name
#endif
static const char *order;
static int position_to_mapped_joints(int n, const EmcPose *p, double *j) {
    double v[9] = {p->tran.x, p->tran.y, p->tran.z, p->a, p->b, p->c, p->u, p->v, p->w};
    for (int i = 0; order[i]; i++) j[i] = v[strchr("XYZABCUVW", order[i]) - "XYZABCUVW"];
    return 0;
}
int main(int argc, char **argv) {
    order = argv[1];
    kparms kp = {"", "trt", "trt", (char *)order, 9, 0};
    if (trtKinematicsSetup(0, order, &kp)) return 1;
    double v[13];
    for (;;) {
        for (int i = 0; i < 13; i++) if (scanf("%lf", v + i) != 1) return 0;
        PIN(x_rot_point) = v[0]; PIN(y_rot_point) = v[1]; PIN(z_rot_point) = v[2];
        PIN(x_offset) = v[3]; PIN(y_offset) = v[4]; PIN(z_offset) = v[5];
        PIN(tool_offset) = v[6];
#ifndef POINTERS
        haldata->conventional_directions = (int)v[7];
#endif
        EmcPose p = {{v[8], v[9], v[10]}, 0, 0, v[12], 0, 0, 0};
        int bc = order[3] == 'B';
        if (bc) p.b = v[11]; else p.a = v[11];
        double j[16] = {0};
        unsigned long f = 0;
        if (bc) xyzbcKinematicsInverse(&p, j, &f, &f); else xyzacKinematicsInverse(&p, j, &f, &f);
        EmcPose q = {{0, 0, 0}, 0, 0, 0, 0, 0, 0};
        double t[9] = {0};
        for (int i = 0; i < 5; i++) t[i] = j[i];
        if (bc) xyzbcKinematicsForward(t, &q, &f, &f); else xyzacKinematicsForward(t, &q, &f, &f);
        double e = fmax(fmax(fabs(q.tran.x - v[8]), fabs(q.tran.y - v[9])), fabs(q.tran.z - v[10]));
        printf("%.17g,%.17g,%.17g,%.3g\\n", j[0], j[1], j[2], e);
    }
}
""",
}

random.seed(20261121)
rows = []
for kind in ("XYZAC", "XYZBC"):
    for conventional in (0, 1):
        for _ in range(100):
            r = lambda w: round(random.uniform(-w, w), 3)
            tilt_offset = r(40)
            offsets = (tilt_offset, 0.0) if kind == "XYZBC" else (0.0, tilt_offset)
            rows.append((kind, [r(300), r(300), r(300), *offsets, r(60), abs(r(150)), conventional,
                                r(200), r(200), r(200), r(110), r(360)]))

answers = [None] * len(rows)
with tempfile.TemporaryDirectory() as folder:
    for name, text in STUBS.items():
        open(os.path.join(folder, name), "w").write(text)
    for conventional, source in enumerate(SOURCES):
        open(os.path.join(folder, "trtfuncs.c"), "w").write(open(source).read())
        binary = os.path.join(folder, "trt")
        flags = [] if conventional else ["-DPOINTERS"]
        main = os.path.join(folder, "main.c")
        subprocess.run(["gcc", "-O2", "-w", *flags, "-I", folder, "-o", binary, main, "-lm"], check=True)
        for kind in ("XYZAC", "XYZBC"):
            which = [i for i, (k, v) in enumerate(rows) if k == kind and v[7] == conventional]
            text = "\n".join(" ".join(map(repr, rows[i][1])) for i in which) + "\n"
            done = subprocess.run([binary, kind], input=text, capture_output=True, text=True, check=True)
            for i, line in zip(which, done.stdout.split(), strict=True):
                *answer, error = line.split(",")
                assert float(error) < 1e-9, (rows[i], line)
                answers[i] = ",".join(answer)

with open(OUT, "w") as file:
    file.write("# joints of tilting rotary tables for tool positions (p, mm, with G43 tool offset), by LinuxCNC's trtfuncs.c:\n")
    file.write("# v2.9.10 (conventional 0) and 2.10.0~pre1, commit 5c41560ebb (conventional 1);\n")
    file.write("# command: python3 oracles/linuxcnc_trt.py trtfuncs-2.9.c trtfuncs-2.10.c\n")
    file.write("kind,x_rot_mm,y_rot_mm,z_rot_mm,x_offset_mm,y_offset_mm,z_offset_mm,tool_mm,conventional,"
               "px_mm,py_mm,pz_mm,tilt_deg,c_deg,x_mm,y_mm,z_mm\n")
    for (kind, v), answer in zip(rows, answers):
        file.write(kind + "," + ",".join(map(repr, v)) + "," + answer + "\n")
