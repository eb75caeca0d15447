/* Eight threads that call the library for the first time at the same moment, and then everything at once in their own order,
 * blocks of shared inputs among it: first with laws of their own, then with laws that one of them has prepared for all. Afterwards
 * the main thread does the same alone: every bit is as there.
 *
 *     threads CASES [ROUNDS [ADDRESS ...]]
 *
 * Compiled with -DDRD, valgrind's drd is told not to report races on the bytes at these addresses. They are relaxed atomics,
 * which a processor loads and stores like any other byte, so that drd cannot know.
 */
#define _GNU_SOURCE /* pthread_barrier_t */
#include <pthread.h>
#ifdef DRD
#include <valgrind/drd.h>
#endif

#include "check.h"

enum { THREADS = 8, MOST_POINTS = 64, LEVELS = 4, LINEAR = TORON_LINEAR_ELASTIC_PROPERTIES,
      LINEAR_STATE = TORON_LINEAR_ELASTIC_STATE };
enum { POINTS, TANGENTS, BLOCKS, LINEAR_BLOCKS, PREPARATIONS, TASKS };
static const size_t sizes[] = {1, 4, 7, 17, MOST_POINTS};
enum { SIZES = sizeof sizes / sizeof *sizes };

/* What all threads read: the cases' properties and F, and blocks of F, component-major. */
static real properties[MOST_CASES][PROPERTIES], deformations[MOST_CASES][9], block_f[9 * MOST_POINTS], block_rest[9 * MOST_POINTS];
static const real linear_properties[LINEAR] = {(real)79.414, (real)0.794, (real)0.126, (real)3.637, 1, 0, 0, 0, 0, 0};
static long rounds = 50;
/* What the first thread prepares for all of them, once each has had its first round. */
static toron_hyperelastic laws[MOST_CASES];
static toron_linear_elastic linear_law;
static int laws_are_shared;
static pthread_barrier_t everyone_is_there;

/* What one thread gets to know. */
typedef struct {
    struct {
        real stress[6], state[STATE], tangent[36];
        int32_t status, tangent_status;
    } points[MOST_CASES];
    struct {
        real stress[6 * MOST_POINTS], state[STATE * MOST_POINTS], linear_stress[6 * MOST_POINTS];
        real linear_state[LINEAR_STATE * MOST_POINTS], axes[9 * MOST_POINTS];
        int32_t status[MOST_POINTS], linear_status[MOST_POINTS];
    } blocks[SIZES][LEVELS];
    struct {
        toron_hyperelastic law;
        toron_linear_elastic linear;
        char text[TORON_MESSAGE_CAPACITY];
        int32_t status;
    } preparations[3];
} answers;

#define PREPARE ENTRY(toron_hyperelastic_prepare)
#define PREPARE_LINEAR ENTRY(toron_linear_elastic_prepare)

/* The law of a case: everyone's, or one that is prepared here. */
static const toron_hyperelastic *law_of(int i, toron_hyperelastic *room)
{
    if (laws_are_shared)
        return &laws[i];
    PREPARE(room, sizeof *room, properties[i], PROPERTIES, NULL, 0);
    return room;
}

static void one_block(answers *a, size_t size, int32_t level)
{
    toron_hyperelastic room;
    real *state = a->blocks[size][level].state;
    const toron_block block = {.size = sizeof block, .n = sizes[size], .leading_dimension = MOST_POINTS, .level = level,
                               .deformation_gradient = {block_f}, .stress = {a->blocks[size][level].stress}, .energies = state,
                               .invariants = state + INVARIANTS * MOST_POINTS, .failure = state + FAILURE * MOST_POINTS,
                               .status = a->blocks[size][level].status};
    if (level % 2 == 0)
        ENTRY(toron_hyperelastic_block)(law_of(0, &room), &block, NULL, 0);
    else
        ENTRY(toron_hyperelastic_block_with_properties)(properties[0], PROPERTIES, &block, NULL, 0);
}

static void one_linear_block(answers *a, size_t size, int32_t level)
{
    real *axes = a->blocks[size][level].axes;
    for (size_t c = 0; c < 9; c++)
        for (size_t i = 0; i < sizes[size]; i++)
            axes[c * MOST_POINTS + i] = c % 4 == 0;
    const toron_linear_block block = {.size = sizeof block, .n = sizes[size], .leading_dimension = MOST_POINTS,
                                      .rotation = (int32_t)size % 3, .criterion = level % 2, .level = level, .f_old = {block_rest},
                                      .f_new = {block_f}, .axes = axes, .state_new = a->blocks[size][level].linear_state,
                                      .stress = {a->blocks[size][level].linear_stress},
                                      .status = a->blocks[size][level].linear_status};
    if (laws_are_shared)
        ENTRY(toron_linear_elastic_block)(&linear_law, &block, NULL, 0);
    else
        ENTRY(toron_linear_elastic_block_with_properties)(linear_properties, LINEAR, &block, NULL, 0);
}

static void prepare_laws(answers *a)
{
    for (size_t i = 0; i < 3; i++) {
        real values[PROPERTIES];
        memcpy(values, properties[0], sizeof values);
        if (i > 0)
            values[i] = -1;
        PREPARE_LINEAR(&a->preparations[i].linear, sizeof a->preparations[i].linear, linear_properties, LINEAR, NULL, 0);
        a->preparations[i].status = PREPARE(&a->preparations[i].law, sizeof a->preparations[i].law, values, PROPERTIES,
                                            a->preparations[i].text, TORON_MESSAGE_CAPACITY);
    }
}

static void run_task(int task, answers *a)
{
    for (int i = 0; (task == POINTS || task == TANGENTS) && i < case_count; i++) {
        toron_hyperelastic room;
        toron_point point = {.size = sizeof point, .measure = TORON_TANGENT_JAUMANN, .deformation_gradient = deformations[i]};
        if (task == POINTS) {
            point.state_new = a->points[i].state, point.stress = a->points[i].stress;
            a->points[i].status = ENTRY(toron_hyperelastic_point)(law_of(i, &room), &point, NULL, 0);
        } else {
            point.tangent = a->points[i].tangent;
            a->points[i].tangent_status = ENTRY(toron_hyperelastic_point_with_properties)(properties[i], PROPERTIES, &point, NULL,
                                                                                          0);
        }
    }
    for (size_t size = 0; (task == BLOCKS || task == LINEAR_BLOCKS) && size < SIZES; size++)
        for (int32_t level = 0; level < LEVELS; level++)
            (task == BLOCKS ? one_block : one_linear_block)(a, size, level);
    if (task == PREPARATIONS)
        prepare_laws(a);
}

typedef struct {
    int number;
    long changes; /* rounds that gave other answers than the first one */
    answers first, again;
} thread;

static void *run(void *argument)
{
    thread *t = argument;
    pthread_barrier_wait(&everyone_is_there);
    for (long round = 0; round <= rounds; round++) {
        answers *a = round == 0 ? &t->first : &t->again;
        for (int i = 0; i < TASKS; i++)
            run_task((i + t->number) % TASKS, a);
        t->changes += memcmp(a, &t->first, sizeof *a) != 0;
        if (round > 0)
            continue;
        pthread_barrier_wait(&everyone_is_there);
        for (int i = 0; t->number == 0 && i < case_count; i++)
            PREPARE(&laws[i], sizeof laws[i], properties[i], PROPERTIES, NULL, 0);
        if (t->number == 0) {
            PREPARE_LINEAR(&linear_law, sizeof linear_law, linear_properties, LINEAR, NULL, 0);
            laws_are_shared = 1;
        }
        pthread_barrier_wait(&everyone_is_there);
    }
    return NULL;
}

/* No call of the library, which is for the threads to use first. */
static void prepare(int argc, char **argv)
{
    read_cases(argc, argv);
    if (argc > 2)
        rounds = strtol(argv[2], NULL, 10);
#ifdef DRD
    for (int i = 3; i < argc; i++)
        ANNOTATE_BENIGN_RACE_SIZED((void *)strtoul(argv[i], NULL, 16), 1, "");
#endif
    for (int i = 0; i < case_count; i++) {
        for (int c = 0; c < PROPERTIES; c++)
            properties[i][c] = (real)cases[i].properties[c];
        for (int c = 0; c < 9; c++)
            deformations[i][c] = (real)cases[i].f[c];
    }
    for (size_t c = 0; c < 9; c++)
        for (size_t i = 0; i < MOST_POINTS; i++) {
            block_f[c * MOST_POINTS + i] = deformations[(int)i % case_count][c];
            block_rest[c * MOST_POINTS + i] = c % 4 == 0;
        }
}

int main(int argc, char **argv)
{
    prepare(argc, argv);
    pthread_t threads[THREADS];
    thread *all = calloc(THREADS, sizeof *all), *alone = calloc(1, sizeof *alone);
    if (all == NULL || alone == NULL || pthread_barrier_init(&everyone_is_there, NULL, THREADS) != 0)
        return 2;
    for (int i = 0; i < THREADS; i++) {
        all[i].number = i;
        if (pthread_create(&threads[i], NULL, run, &all[i]) != 0) {
            fputs("no thread\n", stderr);
            return 2;
        }
    }
    for (int i = 0; i < THREADS; i++)
        pthread_join(threads[i], NULL);
    for (int task = 0; task < TASKS; task++)
        run_task(task, &alone->first);
    CHECK(alone->first.points[0].status == TORON_OK && alone->first.preparations[1].status == TORON_PROPERTY_OUT_OF_BOUNDS,
          "the law");
    for (int i = 0; i < THREADS; i++) {
        CHECK(all[i].changes == 0, "thread %d: %ld rounds differ", i, all[i].changes);
        CHECK(memcmp(&all[i].first, &alone->first, sizeof alone->first) == 0, "thread %d differs", i);
    }
    pthread_barrier_destroy(&everyone_is_there);
    free(all);
    free(alone);
    return finish();
}
