/* One fault of each kind, by name: what looks for faults in the other programs has to find it here.
 *
 *     faults beyond|guard|unwritten|leak|overflow
 */
#include <limits.h>

#include "check.h"

int main(int argc, char **argv)
{
    const char *fault = argc == 2 ? argv[1] : "";
    volatile int *array = malloc(4 * sizeof *array);
    volatile real *guarded_array = reals(4);
    volatile int most = INT_MAX;
    if (array == NULL)
        return 2;
    if (strcmp(fault, "beyond") == 0) {
        memset((void *)array, 0, (size_t)(argc + 3) * sizeof *array);
        most = array[0];
    }
    if (strcmp(fault, "guard") == 0 && guarded_array[argc + 2] == 1)
        puts("a guard is 1");
    if (strcmp(fault, "unwritten") == 0 && guarded_array[argc] == 1)
        puts("an array that holds nothing yet is 1");
    if (strcmp(fault, "overflow") == 0)
        most = most + argc;
    if (strcmp(fault, "leak") == 0)
        array = NULL;
    free((void *)array);
    release();
    return finish();
}
