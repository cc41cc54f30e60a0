/* Seconds to read an array of COUNT doubles once from memory: the best of REPETITIONS streaming sums, each
   thread reading a piece of it.

   read_bandwidth COUNT REPETITIONS THREADS */

#include <pthread.h>
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

struct piece {
    const double* values;
    size_t count;
    double total;
};

static void* read_piece(void* argument) {
    struct piece* piece = argument;
    piece->total = sum(piece->values, piece->count);
    return NULL;
}

/* The calling thread reads the first piece. */
static double sum_by(struct piece* pieces, pthread_t* threads, int count) {
    for (int t = 1; t < count; ++t)
        if (pthread_create(&threads[t], NULL, read_piece, &pieces[t]) != 0)
            exit(1);
    read_piece(&pieces[0]);
    double total = pieces[0].total;
    for (int t = 1; t < count; ++t) {
        pthread_join(threads[t], NULL);
        total += pieces[t].total;
    }
    return total;
}

int main(int argc, char** argv) {
    enum { most_threads = 256 };
    if (argc != 4)
        return 2;
    const size_t count = strtoull(argv[1], NULL, 10);
    const int repetitions = atoi(argv[2]), thread_count = atoi(argv[3]);
    double* values = malloc(count * sizeof(double));
    if (count == 0 || repetitions < 1 || thread_count < 1 || thread_count > most_threads || !values)
        return 1;
    struct piece pieces[most_threads];
    pthread_t threads[most_threads];
    for (int t = 0; t < thread_count; ++t) {
        const size_t begin = count * (size_t)t / (size_t)thread_count,
                     end = count * ((size_t)t + 1) / (size_t)thread_count;
        pieces[t] = (struct piece){values + begin, end - begin, 0.0};
    }
    for (size_t i = 0; i < count; ++i)
        values[i] = 1e-3 * (double)i;

    double best = 1e300, check = 0.0;
    for (int repetition = 0; repetition < repetitions; ++repetition) {
        values[0] = (double)repetition;
        const double begin = now();
        check += sum_by(pieces, threads, thread_count);
        const double seconds = now() - begin;
        if (seconds < best)
            best = seconds;
    }
    printf("%.9g %.17g\n", best, check);
    free(values);
    return 0;
}
