/* Seconds to read an array of COUNT doubles once from memory: the best of REPETITIONS streaming sums.

   read_bandwidth COUNT REPETITIONS */

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { lanes = 32 }; /* independent partial sums: the additions' latency must not limit the reading */

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double sum(const double* values, size_t count) {
    double partial[lanes] = {0.0};
    for (size_t i = 0; i + lanes <= count; i += lanes)
        for (size_t j = 0; j < lanes; ++j)
            partial[j] += values[i + j];
    double total = 0.0;
    for (size_t j = 0; j < lanes; ++j)
        total += partial[j];
    return total;
}

int main(int argc, char** argv) {
    if (argc != 3)
        return 2;
    const size_t count = strtoull(argv[1], NULL, 10);
    const int repetitions = atoi(argv[2]);
    double* values = malloc(count * sizeof(double));
    if (count == 0 || repetitions < 1 || !values)
        return 1;
    for (size_t i = 0; i < count; ++i)
        values[i] = 1e-3 * (double)i;

    double best = 1e300, check = 0.0;
    for (int repetition = 0; repetition < repetitions; ++repetition) {
        values[0] = (double)repetition;
        const double begin = now();
        check += sum(values, count);
        const double seconds = now() - begin;
        if (seconds < best)
            best = seconds;
    }
    printf("%.9g %.17g\n", best, check);
    free(values);
    return 0;
}
