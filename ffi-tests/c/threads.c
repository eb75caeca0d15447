/* Eight threads at once, each over all cases in its own order: every bit as in one thread. */
#include <pthread.h>

#include "check.h"

enum { THREADS = 8, ROUNDS = 50 };

typedef struct {
    real stress[6], state[STATE];
} answer;

static answer alone[MOST_CASES];

static answer evaluate(const truth *t)
{
    answer a;
    real properties[PROPERTIES], f[9];
    for (int i = 0; i < PROPERTIES; i++)
        properties[i] = (real)t->properties[i];
    for (int i = 0; i < 9; i++)
        f[i] = (real)t->f[i];
    ENTRY(toron_hyperelastic_point)(properties, PROPERTIES, f, NULL, NULL, a.state, a.stress, NULL, 0, NULL);
    return a;
}

static void *run(void *argument)
{
    size_t *different = argument, offset = *different;
    *different = 0;
    for (int round = 0; round < ROUNDS; round++)
        for (int i = 0; i < case_count; i++) {
            size_t k = ((size_t)i + offset * 31) % (size_t)case_count;
            answer a = evaluate(&cases[k]);
            *different += memcmp(&a, &alone[k], sizeof a) != 0;
        }
    return NULL;
}

int main(int argc, char **argv)
{
    read_cases(argc, argv);
    for (int i = 0; i < case_count; i++)
        alone[i] = evaluate(&cases[i]);
    pthread_t threads[THREADS];
    size_t different[THREADS];
    for (size_t i = 0; i < THREADS; i++) {
        different[i] = i;
        if (pthread_create(&threads[i], NULL, run, &different[i]) != 0) {
            fputs("no thread\n", stderr);
            return 2;
        }
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
        CHECK(different[i] == 0, "thread %d: %zu different answers", i, different[i]);
    }
    return finish();
}
