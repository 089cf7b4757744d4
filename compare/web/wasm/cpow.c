/* The power of complex numbers that numba's code calls: Python's own, by moduli and angles. */
#include <math.h>

typedef struct { double real, imag; } Complex;

void numba_cpow(const Complex *base, const Complex *exponent, Complex *power)
{
    const double size = hypot(base->real, base->imag);
    double length, angle;
    if (exponent->real == 0 && exponent->imag == 0) {
        power->real = 1;
        power->imag = 0;
        return;
    }
    if (size == 0) {
        power->real = power->imag = exponent->real > 0 && exponent->imag == 0 ? 0 : NAN;
        return;
    }
    length = pow(size, exponent->real);
    angle = atan2(base->imag, base->real) * exponent->real;
    if (exponent->imag != 0) {
        length *= exp(-atan2(base->imag, base->real) * exponent->imag);
        angle += exponent->imag * log(size);
    }
    power->real = length * cos(angle);
    power->imag = length * sin(angle);
}
