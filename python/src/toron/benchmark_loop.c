/* The mean time of a call in a loop of C, in seconds. */
#include <stddef.h>
#include <stdint.h>
#include <time.h>

typedef int32_t block_function(const void *law, const void *block, char *message, size_t capacity);

double mean_time(block_function *function, const void *law, const void *block, int calls)
{
    struct timespec start, end;
    clock_gettime(CLOCK_MONOTONIC, &start);
    for (int call = 0; call < calls; call++)
        function(law, block, NULL, 0);
    clock_gettime(CLOCK_MONOTONIC, &end);
    return ((double)(end.tv_sec - start.tv_sec) + 1e-9 * (double)(end.tv_nsec - start.tv_nsec)) / calls;
}
