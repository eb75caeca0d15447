/* The solver's side of a user library, as far as it is needed here: its routines that a library may call, the loading, the
 * starter's call for a material and the engine's five calls for a group. Written from the interface, not from the solver's source.
 */
#ifndef SOLVER_H
#define SOLVER_H
#define _GNU_SOURCE /* dlopen's flags, feenableexcept, MAP_ANONYMOUS */

#include <dlfcn.h>
#include <fenv.h>
#include <pthread.h>
#include <stdarg.h>
#include <sys/mman.h>
#include <unistd.h>

#include "../c/check.h"

enum { MVSIZ = 129 };

/* ---- The solver's routines */

static _Thread_local int stops;
static _Thread_local char said[400];

void write_iout_(const char *line, const int *length, size_t hidden)
{
    CHECK(hidden == (size_t)*length, "hidden length %zu, length %d", hidden, *length);
    snprintf(said, sizeof said, "%.*s", *length, line);
}

/* The solver's own does not return. */
void arret_(const int *code)
{
    CHECK(*code == 2, "code %d", *code);
    stops++;
}

#define STOPPED_WITH(...)                                                              \
    do {                                                                          \
        CHECK(stops == 1, "stops %d times", stops);                               \
        const char *const parts[] = {__VA_ARGS__};                                \
        for (size_t part = 0; part < sizeof parts / sizeof *parts; part++)        \
            CHECK(strstr(said, parts[part]) != NULL, "\"%s\" in %s", parts[part], said); \
        stops = 0;                                                                \
        said[0] = 0;                                                              \
    } while (0)

/* ---- The library */

static void *library;

typedef void any(); /* with as many arguments as the routine has */

static any *routine(const char *name)
{
    any *found;
    *(void **)&found = dlsym(library, name);
    CHECK(found != NULL, "%s", name);
    return found;
}

static void load(const char *path)
{
    static const char *const needed[] = {
        "st_lecg_", "st_lecguser_", "st_lecm_", "st_lecr_", "st_lecm99_", "st_lecsen_", "st_riniuser_", "st_siniusr_",
        "st_userwis_", "st_userwis_ini_", "userlib_id", "eng_ruser_", "eng_sigeps_", "eng_sigepsc_", "eng_flaw_", "eng_flawc_",
        "eng_suser_", "eng_userint_", "eng_get_uintbuf_var_", "eng_userwi_", "eng_user_sens_", "eng_get_lawc_user_var_",
        "eng_sigeps99c_", "eng_set_lawc_user_var_", "eng_get_law_user_var_", "eng_sigeps99_", "eng_set_law_user_var_",
        "eng_get_law_user_var_2_", "eng_set_law_user_var_2_", "eng_get_lawc_user_var_2_", "eng_set_lawc_user_var_2_"};
    library = dlopen(path, RTLD_LAZY | RTLD_GLOBAL | RTLD_DEEPBIND);
    if (library == NULL) {
        fprintf(stderr, "%s\n", dlerror());
        exit(2);
    }
    for (size_t i = 0; i < sizeof needed / sizeof *needed; i++)
        routine(needed[i]);
    int version = 0;
    routine("userlib_id")(&version);
    CHECK(version >= 1301501260, "version %d: the engine would pass no F", version);
}

/* ---- The starter */

enum { MAXUPARAM = 40 };

typedef struct {
    int nuparam, nuvar, nfunc;
    real uparam[MAXUPARAM], parmat[100];
    char listing[4000];
} material;

/* A card's lines behind the density, through the starter's scratch files. */
static material read_card(int number, const char *card)
{
    material m = {.nuparam = -1, .nuvar = -1, .nfunc = -1};
    for (int i = 0; i < MAXUPARAM; i++)
        m.uparam[i] = NAN;
    const int ilaw = 99, length = 7, maxuparam = MAXUPARAM, maxfunc = 100;
    int ifunc[100];
    FILE *in = fopen("SIone_run_0099.scr", "w");
    fputs(card, in);
    fclose(in);
    remove("SOone_run_0099.scr");
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
    routine("st_lecm99_")(&ilaw, "one_run and more", &length, &number, m.uparam, &maxuparam, &m.nuparam, &m.nuvar, ifunc, &maxfunc,
                          &m.nfunc, m.parmat);
    fedisableexcept(FE_ALL_EXCEPT);
    CHECK(fetestexcept(FE_ALL_EXCEPT) == 0, "exceptions %x", (unsigned)fetestexcept(FE_ALL_EXCEPT));
    FILE *out = fopen("SOone_run_0099.scr", "r");
    if (out != NULL) {
        m.listing[fread(m.listing, 1, sizeof m.listing - 1, out)] = 0;
        fclose(out);
    }
    return m;
}

/* Numbers as a card has them, five fields of 20 columns in a line. */
static const char *card_of(const double *values, int count)
{
    static char card[1000];
    int at = 0;
    for (int i = 0; i < count; i++)
        at += sprintf(card + at, "%20.12g%s", values[i], i % 5 == 4 || i == count - 1 ? "\n" : "");
    return card;
}

/* ---- The engine */

/* An array that ends where a page begins that must not be touched. */
static inline real *at_page_end(size_t count, double value)
{
    const size_t page = 4096, bytes = (count * sizeof(real) + page - 1) / page * page;
    char *start = mmap(NULL, bytes + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (start == MAP_FAILED || mprotect(start + bytes, page, PROT_NONE) != 0)
        exit(2);
    real *array = (real *)(void *)(start + bytes) - count;
    for (size_t i = 0; i < count; i++)
        array[i] = (real)value;
    return array;
}

typedef struct {
    const material *m;
    int number, nel, cycle, *ngl;
    real time, *rho0, *f[9], *sign[6], *sigv[6], *ssp, *vis, *uvar, *off, *unread;
    real *volume; /* no numbers, where nothing is to be concluded from them */
} group;

/* The group in whose cycle a routine of the engine is called. */
static _Thread_local const group *current;

/* F: XX YY ZZ XY YZ ZX YX ZY XZ. */
static const int row_of_f[9] = {0, 1, 2, 0, 1, 2, 1, 2, 0}, column_of_f[9] = {0, 1, 2, 1, 2, 0, 0, 1, 2};

/* `length` is that of the arrays of F and stress: the solver's MVSIZ, or no more than the group needs. */
static inline group new_group(const material *m, int number, int nel, size_t length)
{
    group g = {.m = m, .number = number, .nel = nel};
    g.rho0 = at_page_end(length, 1351.4);
    for (int c = 0; c < 9; c++) {
        g.f[c] = at_page_end(length, NAN);
        for (int i = 0; i < nel; i++)
            g.f[c][i] = c < 3;
    }
    for (int c = 0; c < 6; c++) {
        g.sign[c] = at_page_end(length, -7.5);
        g.sigv[c] = at_page_end(length, 0); /* as the solver does */
    }
    g.ssp = at_page_end(nel, 0);
    g.vis = at_page_end(nel, 0);
    g.off = at_page_end(nel, 1);
    g.uvar = at_page_end((size_t)nel * (size_t)m->nuvar, 0);
    g.unread = at_page_end(MVSIZ, NAN);
    g.volume = at_page_end(nel, NAN);
    g.ngl = malloc(sizeof(int) * (size_t)nel);
    for (int i = 0; i < nel; i++)
        g.ngl[i] = 5000 + i;
    return g;
}

static inline real *variable(const group *g, int number, int element)
{
    return &g->uvar[(size_t)(number - 1) * (size_t)g->nel + (size_t)element];
}

static inline void set_f(group *g, int element, const double *f)
{
    for (int c = 0; c < 9; c++)
        g->f[c][element] = (real)f[3 * row_of_f[c] + column_of_f[c]];
}

/* Columns, as the library's own entries take it. */
static inline void get_f(const group *g, int element, real f[9])
{
    for (int c = 0; c < 9; c++)
        f[3 * column_of_f[c] + row_of_f[c]] = g->f[c][element];
}

/* Waits for the other threads between two calls, so that these interleave; null for one thread. */
static pthread_barrier_t *between_calls;

static inline void others(void)
{
    if (between_calls != NULL)
        pthread_barrier_wait(between_calls);
}

#define U4 u, u, u, u
#define U6 u, u, u, u, u, u
#define V8 u, &none, u, &none, u, &none, u, &none, u, &none, u, &none, u, &none, u, &none

/* The five calls, with exceptions trapped as a debug build of the solver does. */
static inline void cycle(group *g)
{
    const int id = 7, one = 1, size = MVSIZ, none = 0, nfunc = 0, npf[1] = {0};
    real *const u = g->unread, **f = g->f, **s = g->sign, **v = g->sigv;
    current = g;
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
    routine("eng_get_law_user_var_")(&g->cycle, &id, &one, &one, &one, u, u, u, U6, U6, U6, U6,
                                     U6, g->rho0, s[0], s[1], s[2], s[3], s[4], s[5], v[0], v[1], v[2], v[3], v[4], v[5]);
    others();
    routine("eng_get_law_user_var_2_")(f[0], &size, f[1], &size, f[2], &size, f[3], &size, f[4], &size, f[5], &size, f[6], &size, f[7],
                                       &size, f[8], &size, u, &size, u, &size, u, &size, u, &size, u, &size, u, &size, u, &g->nel, u,
                                       &size, V8, V8, V8, V8, V8, V8, V8, V8, V8, V8, u, &none);
    others();
    routine("eng_sigeps99_")(&g->nel, &g->m->nuparam, &g->m->nuvar, &g->number, &nfunc, npf, npf, u, &g->time, u, g->m->uparam, u,
                             g->volume, u, g->ngl, g->ssp, g->vis, g->uvar, g->off, u, u);
    others();
    routine("eng_set_law_user_var_")(s[0], s[1], s[2], s[3], s[4], s[5], v[0], v[1], v[2], v[3], v[4], v[5], u);
    others();
    routine("eng_set_law_user_var_2_")(u, &g->nel, V8, V8, V8, V8, V8, V8, V8, V8, V8, V8, V8, V8, u, &none);
    fedisableexcept(FE_ALL_EXCEPT);
    CHECK(fetestexcept(FE_ALL_EXCEPT) == 0, "exceptions are left raised");
    g->cycle++;
    g->time += (real)1e-8;
}

#endif
