/* The library that the solver loads by itself, called as the engine does: against the library's own entries at every point. */
#include "solver.h"

/* What the two ways of evaluating a point may differ by. F and the fibre are rounded in proportion to 1, and the stress to the
 * stiffness of the fibre, the energies to what it stores at a tenth of strain; the linear elastic law adds up steps. */
#ifdef SINGLE
static const double precision = 4e-6;
#else
static const double precision = 2e-14;
#endif
static const double stiffness = 82341;

static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

/* ---- Nodes: of a brick whose sections are apart along `axis`, which turns with the element, moved by the group's F. */

static _Thread_local int without_length;
static _Thread_local double stretched = 1;
/* What has moved the nodes where that is not the F that is passed, row by row. */
static _Thread_local const double *moved_by;

static void axis_of(int element, double axis[3])
{
    const double angle = 0.01 * element;
    axis[0] = cos(angle), axis[1] = sin(angle), axis[2] = 0.3;
}

void mat_solid_get_nod_x_(real *x)
{
    const int n = current->nel;
    fenv_t environment;
    feholdexcept(&environment);
    static const double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int i = 0; i < n; i++) {
        double axis[3];
        axis_of(i, axis);
        real f[9];
        get_f(current, i, f);
        for (int node = 0; node < 8; node++) {
            double first[3];
            for (int c = 0; c < 3; c++) {
                double across = c == 2 ? -corner[node % 4][0] : corner[node % 4][1] * (c == 0 ? -axis[1] : axis[0]);
                double along = node < 4 || i == without_length - 1 ? 0 : stretched * axis[c];
                first[c] = 0.5 * across + along;
            }
            for (int c = 0; c < 3; c++) {
                double sum = 0;
                for (int k = 0; k < 3; k++)
                    sum += first[k] * (moved_by ? moved_by[3 * c + k] : (double)f[c + 3 * k]);
                x[i + n * (node + 8 * c)] = (real)sum;
            }
        }
    }
    fesetenv(&environment);
}

/* ---- What the library's own entries say */

typedef struct {
    real state[STATE], stress[6], speed;
} yarn_answer;

/* One step of element `i`, with this fibre direction or, null, that of the card. */
static yarn_answer point(const group *g, int i, const yarn_answer *before, const real *fibre)
{
    yarn_answer a = {0};
    real f[9];
    get_f(g, i, f);
    ENTRY(toron_point) p = {.size = sizeof p, .deformation_gradient = f, .fibre = fibre, .state_old = before->state,
                            .state_new = a.state, .stress = a.stress, .density = (real)1351.4, .wave_speed = &a.speed};
    ENTRY(toron_hyperelastic_point_with_properties)(g->m->uparam + 1, PROPERTIES, &p, NULL, 0);
    return a;
}

/* `least`: what these numbers are rounded in proportion to, where they are smaller. */
static void compare(const char *what, int i, int count, const real *expected, const real *found, size_t distance, double least)
{
    double size = least, error = 0;
    for (int c = 0; c < count; c++) {
        double a = expected[c], b = found[(size_t)c * distance];
        size = fmax(size, fabs(a));
        error = fmax(error, a == b ? 0 : fabs(a - b));
    }
    CHECK(error <= precision * size, "%s of element %d: %g of %g", what, i, error, size);
}

static void compare_stress(const group *g, int i, const real *expected)
{
    real found[6];
    for (int c = 0; c < 6; c++)
        found[c] = g->sign[c][i];
    compare("stress", i, 6, expected, found, 1, stiffness);
    CHECK(g->sigv[0][i] == 0 && g->sigv[2][i] == 0 && g->sigv[5][i] == 0 && g->vis[i] == 0, "viscosity of element %d", i);
}

/* ---- A deformation of an element's own: pulled, pressed, sheared and turned more from cycle to cycle. */

static void deform(group *g, int i, int step)
{
    const double t = step / 20.0, a = 0.02 * t * (1 + i % 5), b = 1 - 0.2 * t * (i % 7) / 7, turn = 0.5 * t + 0.1 * i * t;
    const double c = cos(turn), s = sin(turn), shear = 0.1 * t * (i % 3);
    const double upper[9] = {1 + a, shear, 0.05 * t, 0, b, 0.02 * t * (i % 4), 0, 0, 1};
    double f[9];
    for (int k = 0; k < 3; k++) {
        f[k] = c * upper[k] - s * upper[3 + k];
        f[3 + k] = s * upper[k] + c * upper[3 + k];
        f[6 + k] = upper[6 + k];
    }
    set_f(g, i, f);
}

static const double yarn[12] = {82341, 1055, 2.2, 649.74, 0, 0.0458, 1.8, 0, 1, 0, 0, 0};
static const double linear[13] = {79414, 794, 126, 3637, 1, 0, 0, 0, 0, 0, 0, 0, 0};
enum { DELETED = 15, LINEAR_DELETED = 14 };

/* Cycles of a group of the hyperelastic law; the fibre from the card, the nodes or initial values. */
static void run_yarn(int nel, size_t length, int fibre_from, const double direction[3])
{
    double card[12];
    memcpy(card, yarn, sizeof card);
    memcpy(card + 8, direction, 3 * sizeof(double));
    card[11] = fibre_from;
    material m = read_card(1, card_of(card, 12));
    CHECK(stops == 0, "%s", said);
    group g = new_group(&m, 1, nel, length);
    yarn_answer *before = calloc((size_t)nel, sizeof *before);
    int failed = 0;
    for (int step = 0; step < 20; step++) {
        real fibre[3];
        for (int i = 0; i < nel; i++) {
            if (step > 0 && g.off[i] == 1)
                deform(&g, i, step);
            else
                set_f(&g, i, identity);
            if (step == 0 && fibre_from == 2)
                for (int c = 0; c < 3; c++)
                    *variable(&g, 12 + c, i) = (real)(1 + c * (1 + i % 4));
        }
        cycle(&g);
        CHECK(stops == 0, "%s", said);
        for (int i = 0; i < nel; i++) {
            double axis[3] = {1, 1.0 * (2 + i % 4), 1 + 2.0 * (1 + i % 4)};
            if (fibre_from == 1)
                axis_of(i, axis);
            for (int c = 0; c < 3; c++)
                fibre[c] = (real)(fibre_from == 2 ? 1 + c * (1 + i % 4) : axis[c]);
            yarn_answer now = point(&g, i, &before[i], fibre_from == 0 ? NULL : fibre);
            compare_stress(&g, i, now.stress);
            compare("energies", i, 4, now.state, variable(&g, 1, i), (size_t)nel, 0.1 * stiffness);
            compare("invariants", i, 4, now.state + 4, variable(&g, 5, i), (size_t)nel, 1);
            compare("wave speed", i, 1, &now.speed, &g.ssp[i], 1, 0);
            CHECK(*variable(&g, 10, i) == now.state[FAILED] && g.off[i] == now.state[ALIVE], "failure of element %d", i);
            CHECK(*variable(&g, DELETED, i) == now.state[FAILED], "deleted %g", (double)*variable(&g, DELETED, i));
            failed += now.state[FAILED] > 0 && before[i].state[FAILED] == 0;
            before[i] = now;
        }
    }
    CHECK(nel < 7 || fibre_from != 0 || failed > 0, "no element fails");
    CHECK(failed < nel || nel == 1, "all elements fail");
    free(before);
}

/* The linear elastic law over steps, which needs the F of the step before; the frame follows the fibre or the rotation. */
static void run_linear(int nel, size_t length, int frame, int fibre_from)
{
    double card[13];
    memcpy(card, linear, sizeof card);
    card[10] = fibre_from, card[11] = frame, card[12] = 1;
    material m = read_card(2, card_of(card, 13));
    CHECK(stops == 0, "%s", said);
    group g = new_group(&m, 2, nel, length);
    enum { COUNT = TORON_LINEAR_ELASTIC_STATE };
    real(*states)[COUNT] = calloc((size_t)nel, sizeof *states), (*f_old)[9] = calloc((size_t)nel, sizeof *f_old);
    for (int step = 0; step < 20; step++) {
        for (int i = 0; i < nel; i++)
            if (step > 0 && g.off[i] == 1)
                deform(&g, i, step);
            else
                set_f(&g, i, identity);
        cycle(&g);
        CHECK(stops == 0, "%s", said);
        for (int i = 0; i < nel; i++) {
            real f[9], stress[6], fibre[3], new_state[COUNT], speed;
            double axis[3];
            axis_of(i, axis);
            for (int c = 0; c < 3; c++)
                fibre[c] = (real)axis[c];
            get_f(&g, i, f);
            if (step == 0)
                memcpy(f_old[i], f, sizeof f);
            ENTRY(toron_linear_point) p = {
                .size = sizeof p, .rotation = frame == 0 ? TORON_ROTATION_FIBRE : TORON_ROTATION_POLAR,
                .criterion = TORON_CRITERION_FIBRE, .f_old = f_old[i], .f_new = f, .fibre = fibre_from ? fibre : NULL,
                .state_old = states[i], .state_new = new_state, .stress = stress, .density = (real)1351.4, .wave_speed = &speed};
            ENTRY(toron_linear_elastic_point_with_properties)(m.uparam + 1, 10, &p, NULL, 0);
            compare_stress(&g, i, stress);
            compare("state", i, 6, new_state, variable(&g, 1, i), (size_t)nel, stiffness);
            compare("work", i, 1, new_state + 7, variable(&g, 8, i), (size_t)nel, 0.1 * stiffness);
            compare("wave speed", i, 1, &speed, &g.ssp[i], 1, 0);
            CHECK(*variable(&g, 9, i) == new_state[8] && g.off[i] == new_state[9], "failure of element %d", i);
            CHECK(*variable(&g, LINEAR_DELETED, i) == new_state[8], "deleted of element %d", i);
            memcpy(states[i], new_state, sizeof new_state);
            memcpy(f_old[i], f, sizeof f);
        }
    }
    free(states);
    free(f_old);
}

/* ---- What takes an element out */

static void check_out(const group *g, int i, double reason, const real state[11])
{
    CHECK(g->off[i] == 0 && *variable(g, DELETED, i) == (real)reason, "element %d: OFF %g, deleted %g", i, (double)g->off[i],
          (double)*variable(g, DELETED, i));
    CHECK(*variable(g, 10, i) == 1 && *variable(g, 11, i) == 0, "the latch of element %d", i);
    for (int v = 0; v < 9; v++)
        CHECK(*variable(g, v + 1, i) == state[v], "variable %d of element %d", v + 1, i);
    CHECK(isfinite(g->ssp[i]) && g->ssp[i] > 0, "wave speed %g", (double)g->ssp[i]);
}

static void taken_out(void)
{
    enum { NEL = 9 };
    material m = read_card(1, card_of(yarn, 12));
    group g = new_group(&m, 1, NEL, MVSIZ);
    cycle(&g);
    real before[NEL][11];
    const double pulled[9] = {1.02, 0, 0, 0, 0.9, 0, 0, 0, 1}, broken[9] = {1.06, 0, 0, 0, 1, 0, 0, 0, 1};
    const double inverted[9] = {1, 0, 0, 0, -1, 0, 0, 0, 1}, no_number[9] = {NAN, 0, 0, 0, 1, 0, 0, 0, 1};
    const double most = sizeof(real) == 4 ? 1e30 : 1e200, huge[9] = {most, 0, 0, 0, most, 0, 0, 0, most};
    for (int i = 0; i < NEL; i++)
        set_f(&g, i, pulled);
    cycle(&g);
    for (int i = 0; i < NEL; i++)
        for (int v = 0; v < 11; v++)
            before[i][v] = *variable(&g, v + 1, i);
    set_f(&g, 1, broken);
    set_f(&g, 2, inverted);
    set_f(&g, 3, no_number);
    set_f(&g, 6, huge);
    g.off[4] = 0; /* by another criterion, which fades the element out, or at once */
    g.off[5] = (real)0.8;
    set_f(&g, 4, identity);
    cycle(&g);
    CHECK(stops == 0, "%s", said);
    CHECK(g.sign[0][1] > 4000, "the stress of the cycle in which it fails: %g", (double)g.sign[0][1]);
    CHECK(g.off[1] == 0 && *variable(&g, DELETED, 1) == 1, "failed: OFF %g", (double)g.off[1]);
    for (int v = 0; v < 11; v++)
        before[1][v] = *variable(&g, v + 1, 1);
    CHECK(before[1][8] > 1, "index %g", (double)before[1][8]);
    for (int again = 0; again < 3; again++) {
        check_out(&g, 1, 1, before[1]);
        check_out(&g, 2, TORON_INVERTED, before[2]);
        check_out(&g, 3, TORON_NOT_FINITE, before[3]);
        check_out(&g, 4, 2, before[4]);
        check_out(&g, 5, 2, before[5]);
        CHECK(*variable(&g, DELETED, 6) < -300, "too large: %g", (double)*variable(&g, DELETED, 6));
        CHECK(g.off[0] == 1 && g.off[7] == 1 && *variable(&g, DELETED, 0) == 0, "the others go on");
        for (int i = 1; i <= 6; i++)
            set_f(&g, i, identity); /* the solver scales F - 1 by OFF */
        cycle(&g);
        for (int i = 1; i <= 6; i++)
            for (int c = 0; c < 6; c++)
                CHECK(g.sign[c][i] == 0, "stress of element %d", i);
        CHECK(g.sign[0][7] > 1000, "stress of an intact element: %g", (double)g.sign[0][7]);
    }
}

/* Whatever a model or a restart has in the variables of an element that is out, it stays out, with a reason; and what it has in
 * `deleted` of an intact element at first is no reason later. */
static void variables_that_contradict(void)
{
    static const double reasons[] = {0, 1, 2, TORON_INVERTED, 7, NAN}, latches[] = {0, 1, NAN}, offs[] = {0, 0.8, 1};
    enum { REASONS = 6, LATCHES = 3, OFFS = 3, NEL = REASONS * LATCHES * OFFS };
    const double pulled[9] = {1.02, 0, 0, 0, 0.9, 0, 0, 0, 1}, broken[9] = {1.06, 0, 0, 0, 1, 0, 0, 0, 1};
    for (int later = 0; later < 2; later++) {
        material m = read_card(1, card_of(yarn, 12));
        group g = new_group(&m, 1, NEL, MVSIZ);
        if (later)
            cycle(&g);
        for (int i = 0; i < NEL; i++) {
            *variable(&g, 1, i) = 3;
            *variable(&g, DELETED, i) = (real)reasons[i % REASONS];
            *variable(&g, 10, i) = (real)latches[i / REASONS % LATCHES];
            g.off[i] = (real)offs[i / REASONS / LATCHES];
            set_f(&g, i, pulled);
        }
        for (int again = 0; again < 3; again++) {
            cycle(&g);
            CHECK(stops == 0, "%s", said);
            for (int i = 0; i < NEL; i++) {
                const double reason = reasons[i % REASONS], latch = latches[i / REASONS % LATCHES], off = offs[i / REASONS / LATCHES];
                const double deleted = *variable(&g, DELETED, i);
                if (off == 1 && latch == 0) {
                    CHECK(g.off[i] == 1 && g.sign[0][i] > 1000, "element %d: OFF %g", i, (double)g.off[i]);
                    CHECK(later || deleted == 0, "element %d: deleted %g", i, deleted);
                    continue;
                }
                CHECK(g.off[i] == 0 && *variable(&g, 10, i) == 1 && *variable(&g, 11, i) == 0, "element %d: OFF %g", i, (double)g.off[i]);
                CHECK(*variable(&g, 1, i) == 3, "element %d: the state", i);
                CHECK(fabs(reason) > 0 ? deleted == reason : deleted == (off < 1 ? 2 : latch == 1 ? 1 : TORON_STATE_NOT_FINITE),
                      "element %d: deleted %g", i, deleted);
                for (int c = 0; c < 6; c++)
                    CHECK(g.sign[c][i] == 0, "stress of element %d", i);
            }
        }
        for (int i = 0; i < NEL; i++)
            set_f(&g, i, broken);
        cycle(&g);
        for (int i = 0; i < NEL; i++)
            CHECK(g.off[i] == 0 && *variable(&g, 10, i) == 1 && fabs((double)*variable(&g, DELETED, i)) > 0, "element %d breaks", i);
    }
}

/* ---- What stops the run */

static void stopped(void)
{
    double card[12];
    memcpy(card, yarn, sizeof card);
    material m = read_card(1, card_of(card, 12));
    group g = new_group(&m, 1, 3, MVSIZ);
    for (int c = 0; c < 9; c++)
        for (int i = 0; i < 3; i++)
            g.f[c][i] = 0; /* any Ismstr but 10 */
    cycle(&g);
    STOPPED_WITH("/MAT/USER01/7", "F = 0", "/PROP/TYPE14", "Isolid = 1", "Ismstr = 10", "Iframe = 1");
    CHECK(g.off[0] == 1 && g.off[2] == 1, "no element is deleted");

    card[11] = 1;
    m = read_card(1, card_of(card, 12));
    g = new_group(&m, 1, 5, MVSIZ);
    without_length = 3;
    cycle(&g);
    STOPPED_WITH("element 5002", "fibre direction");
    without_length = 0;
    stretched = 0.3; /* nodes 1 to 4 are no section of the yarn: fibre across flat elements */
    g = new_group(&m, 1, 5, MVSIZ);
    cycle(&g);
    STOPPED_WITH("/MAT/USER01/7: element 5000", "fibre_from = 1", "nodes 1 to 4 must be a section");
    stretched = 1;

    card[11] = 2;
    m = read_card(1, card_of(card, 12));
    g = new_group(&m, 1, 5, MVSIZ);
    for (int i = 0; i < 4; i++)
        *variable(&g, 12, i) = 1; /* the last element has been forgotten */
    cycle(&g);
    STOPPED_WITH("element 5004", "fibre direction");
    g.time = 1; /* and in a later cycle */
    cycle(&g);
    STOPPED_WITH("element 5004", "fibre direction");

    material other = m;
    other.nuvar = 11;
    g = new_group(&other, 1, 2, MVSIZ);
    cycle(&g);
    STOPPED_WITH("NUVAR: 11 given, 18 needed");
    other = m;
    other.nuparam = 12;
    g = new_group(&other, 1, 2, MVSIZ);
    cycle(&g);
    STOPPED_WITH("NUPARAM: 12 given, 14 needed");
    other = m;
    other.uparam[0] = 5;
    g = new_group(&other, 5, 2, MVSIZ);
    cycle(&g);
    STOPPED_WITH("nn of /MAT/USERnn is 5");
    g = new_group(&m, 1, 2, MVSIZ);
    g.rho0[0] = 0;
    *variable(&g, 12, 0) = *variable(&g, 12, 1) = 1;
    cycle(&g);
    STOPPED_WITH("density", "0.0");
    routine("eng_get_lawc_user_var_")();
    STOPPED_WITH("shells");
}

/* Elements that have been strained and then turn, of which F comes in axes that turn with them, on both sides as the
 * solver has it for an orthotropic property and for co-rotational elements. Nothing strains them while they turn. */
static void other_axes(void)
{
    material m = read_card(1, card_of(yarn, 12));
    enum { NEL = 3 };
    group g = new_group(&m, 1, NEL, MVSIZ);
    const double a = 1.02, b = 0.95;
    for (int step = 0; step < 400 && stops == 0; step++) {
        const double part = fmin(step / 100.0, 1), angle = fmax(step - 100, 0) * 0.005;
        const double c = cos(angle), s = sin(angle), u = 1 + part * (a - 1), v = 1 + part * (b - 1);
        const double global[9] = {c * u, -s * v, 0, s * u, c * v, 0, 0, 0, 1}; /* turn times stretch */
        const double turning[9] = {u * c, -u * s, 0, v * s, v * c, 0, 0, 0, 1}; /* stretch times turn */
        for (int i = 0; i < NEL; i++)
            set_f(&g, i, global);
        /* One that is out, of which the solver passes what it likes, and later one of an orthotropic property. */
        set_f(&g, 0, turning);
        g.off[0] = step < 50;
        if (step >= 300)
            set_f(&g, 1, turning);
        moved_by = global;
        cycle(&g);
        CHECK(stops == 0 || step >= 300, "after %d cycles: %s", step, said);
        CHECK(stops == 1 || step < 300 + 64, "not after %d cycles", step);
    }
    moved_by = NULL;
    STOPPED_WITH("/MAT/USER01/7: element 5001", "not in the global axes", "TYPE14", "Isolid = 1", "Iframe = 1");
}

/* The library of the other precision: what it reads in the first cycle, where F is 1. */
static void other_precision(void)
{
    material m = read_card(1, card_of(yarn, 12));
    group g = new_group(&m, 1, 2, MVSIZ);
    for (int c = 0; c < 9; c++) {
        const double value = c < 3;
        const float twice[2] = {(float)value, (float)value};
        if (sizeof(real) == sizeof(float)) /* an array of double precision, of which half of a number is read */
            memcpy(g.f[c], &value, sizeof value);
        else
            for (int i = 0; i < 2; i++)
                memcpy(&g.f[c][i], twice, sizeof twice);
    }
    cycle(&g);
    STOPPED_WITH("precision", sizeof(real) == sizeof(float) ? "use libtoron_openradioss.so" : "use libtoron_openradioss_sp.so");
}

/* ---- Threads, each with groups of both laws, whose calls interleave */

enum { THREADS = 4 };
static pthread_barrier_t barrier;

typedef struct {
    const material *m[2];
    int thread, stops;
    double sum[2];
} work;

static void *in_thread(void *argument)
{
    work *w = argument;
    for (int law = 0; law < 2; law++) {
        const int mine = (law + w->thread) % 2;
        group g = new_group(w->m[mine], mine + 1, 40 + w->thread, MVSIZ);
        w->sum[mine] = 0;
        for (int step = 0; step < 20; step++) {
            for (int i = 0; i < g.nel; i++)
                if (step == 0 || g.off[i] != 1)
                    set_f(&g, i, identity);
                else
                    deform(&g, i + 3 * w->thread, step);
            cycle(&g);
            for (int i = 0; i < g.nel; i++)
                w->sum[mine] += (double)g.sign[0][i] + 3 * (double)g.sign[3][i] + 1e-3 * (double)g.ssp[i];
        }
    }
    w->stops = stops;
    return NULL;
}

static void threads(void)
{
    const material m[2] = {read_card(1, card_of(yarn, 12)), read_card(2, card_of(linear, 13))};
    work together[THREADS], alone[THREADS];
    pthread_t thread[THREADS];
    pthread_barrier_init(&barrier, NULL, THREADS);
    for (int k = 0; k < THREADS; k++)
        together[k] = alone[k] = (work){{&m[0], &m[1]}, k, 0, {0, 0}};
    for (int k = 0; k < THREADS; k++)
        in_thread(&alone[k]);
    between_calls = &barrier;
    for (int k = 0; k < THREADS; k++)
        if (pthread_create(&thread[k], NULL, in_thread, &together[k]) != 0)
            exit(2);
    for (int k = 0; k < THREADS; k++)
        pthread_join(thread[k], NULL);
    between_calls = NULL;
    for (int k = 0; k < THREADS; k++) {
        CHECK(together[k].stops == 0, "thread %d stops the run", k);
        for (int law = 0; law < 2; law++) {
            CHECK(together[k].sum[law] == alone[k].sum[law], "thread %d, law %d", k, law + 1);
            CHECK(fabs(alone[k].sum[law]) > 1000, "no stress");
        }
    }
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    load(argv[1]);
    static const int sizes[] = {1, 2, 7, 8, 127, 128, 129, 300}; /* the solver has up to 128; a longer group does not matter */
    static const double along_x[3] = {1, 0, 0}, inclined[3] = {0.6, 0.8, 0.1};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        const int n = sizes[k];
        for (int tight = 0; tight < 2; tight++) {
            const size_t length = tight || n > MVSIZ ? (size_t)n : MVSIZ;
            run_yarn(n, length, 0, along_x);
            run_yarn(n, length, 0, inclined);
            run_yarn(n, length, 1, along_x);
            run_yarn(n, length, 2, along_x);
            for (int frame = 0; frame < 2; frame++)
                for (int fibre_from = 0; fibre_from < 2; fibre_from++)
                    run_linear(n, length, frame, fibre_from);
        }
    }
    taken_out();
    variables_that_contradict();
    stopped();
    other_axes();
    other_precision();
    threads();
    return finish();
}
