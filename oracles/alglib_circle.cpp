// Cross-check of fits.py with ALGLIB (Debian libalglib-dev 3.19): stdin "fit n\n x y ..."; fit 1 = MCC, 2 = MIC, 3 = MZC
// g++ -O2 -I/usr/include/libalglib -o alglib_circle alglib_circle.cpp -lalglib
#include "interpolation.h"
#include <cstdio>
using namespace alglib;
int main() {
    int fit, n;
    if (scanf("%d %d", &fit, &n) != 2) return 1;
    real_2d_array xy;
    xy.setlength(n, 2);
    for (int i = 0; i < n; i++)
        if (scanf("%lf %lf", &xy[i][0], &xy[i][1]) != 2) return 1;
    real_1d_array c;
    double rlo = 0, rhi = 0;
    if (fit == 1) fitspheremc(xy, n, 2, c, rhi);
    if (fit == 2) fitspheremi(xy, n, 2, c, rlo);
    if (fit == 3) fitspheremz(xy, n, 2, c, rlo, rhi);
    printf("%.17g %.17g %.17g %.17g\n", c[0], c[1], rlo, rhi);
}
