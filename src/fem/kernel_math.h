/* Read before every kernel: powers with an exponent that is known when the kernel runs. Most often it is 1,
   as in linear compliance, and pow() takes longer than all else in the law. */
#ifndef THERMOCONTACT_KERNEL_MATH_H
#define THERMOCONTACT_KERNEL_MATH_H

#include <math.h>

static inline double thermocontact_power(double base, double exponent) {
    return exponent == 1.0 ? base : exponent == 0.0 ? 1.0 : pow(base, exponent);
}

#define pow(base, exponent) thermocontact_power(base, exponent)

#endif
