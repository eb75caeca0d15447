/* The routines of Abaqus that user subroutines call, for `toron check`. All are weak: a file that has its own keeps it. What is not
   here is reported when it is called. Character arguments have their lengths behind the last argument. */
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define WEAK __attribute__((weak))
/* Exit codes that the program knows. */
enum { ENDED_BY_XIT = 71, ENDED_BY_MESSAGE = 72 };

WEAK void xit_(void) { _exit(ENDED_BY_XIT); }
WEAK void xplb_exit_(void) { _exit(ENDED_BY_XIT); }

static void message(const int *level, const char *text, size_t length) {
    while (length > 0 && text[length - 1] == ' ') length--;
    if (*level == -3) {
        fprintf(stderr, "%.*s\n", (int)length, text);
        _exit(ENDED_BY_MESSAGE);
    }
}

WEAK void stdb_abqerr_(const int *level, const char *text, const int *integers, const double *reals, const char *names,
                       size_t length, size_t length_of_names) {
    (void)integers, (void)reals, (void)names, (void)length_of_names;
    message(level, text, length);
}
WEAK void xplb_abqerr_(const int *level, const char *text, const int *integers, const double *reals, const char *names,
                       size_t length, size_t length_of_names) {
    (void)integers, (void)reals, (void)names, (void)length_of_names;
    message(level, text, length);
}

/* A component of a symmetric tensor, 11 22 33 12 13 23; without 33 where there are two direct ones. Strains have twice the shears. */
static void square(const double *values, const int *type, const int *direct, const int *shear, double out[3][3]) {
    static const int place[3][2] = {{0, 1}, {0, 2}, {1, 2}};
    double factor = *type == 2 ? 0.5 : 1.0;
    memset(out, 0, 9 * sizeof(double));
    for (int i = 0; i < *direct; i++) out[i][i] = values[i];
    for (int i = 0; i < *shear; i++) {
        double value = factor * values[*direct + i];
        out[place[i][0]][place[i][1]] = value;
        out[place[i][1]][place[i][0]] = value;
    }
}

/* Jacobi's rotations; axes in rows, as SPRIND returns them. */
static void eigen(double a[3][3], double values[3], double axes[3][3]) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) axes[i][j] = i == j;
    for (int sweep = 0; sweep < 60; sweep++) {
        if (a[0][1] == 0.0 && a[0][2] == 0.0 && a[1][2] == 0.0) break;
        for (int p = 0; p < 2; p++)
            for (int q = p + 1; q < 3; q++) {
                /* What is below rounding turns nothing: theta and its square would overflow. */
                if (fabs(a[p][q]) <= 1e-17 * (fabs(a[p][p]) + fabs(a[q][q]))) {
                    a[p][q] = a[q][p] = 0.0;
                    continue;
                }
                double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
                double t = (theta >= 0 ? 1.0 : -1.0) / (fabs(theta) + sqrt(theta * theta + 1.0));
                double c = 1.0 / sqrt(t * t + 1.0), s = t * c;
                for (int k = 0; k < 3; k++) {
                    double x = a[k][p], y = a[k][q];
                    a[k][p] = c * x - s * y;
                    a[k][q] = s * x + c * y;
                }
                for (int k = 0; k < 3; k++) {
                    double x = a[p][k], y = a[q][k];
                    a[p][k] = c * x - s * y;
                    a[q][k] = s * x + c * y;
                    x = axes[p][k], y = axes[q][k];
                    axes[p][k] = c * x - s * y;
                    axes[q][k] = s * x + c * y;
                }
                a[p][q] = a[q][p] = 0.0;
            }
    }
    for (int i = 0; i < 3; i++) values[i] = a[i][i];
}

WEAK void sprinc_(const double *s, double *ps, const int *type, const int *direct, const int *shear) {
    double a[3][3], axes[3][3];
    square(s, type, direct, shear, a);
    eigen(a, ps, axes);
}

WEAK void sprind_(const double *s, double *ps, double *an, const int *type, const int *direct, const int *shear) {
    double a[3][3], axes[3][3];
    square(s, type, direct, shear, a);
    eigen(a, ps, axes);
    /* AN(K1, I), Fortran's order. */
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) an[k + 3 * i] = axes[k][i];
}

WEAK void sinv_(const double *s, double *first, double *second, const int *direct, const int *shear) {
    double a[3][3], sum = 0.0;
    int stress = 1;
    square(s, &stress, direct, shear, a);
    *first = (a[0][0] + a[1][1] + a[2][2]) / 3.0;
    for (int i = 0; i < 3; i++) a[i][i] -= *first;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) sum += a[i][j] * a[i][j];
    *second = sqrt(1.5 * sum);
}

WEAK void rotsig_(const double *s, const double *r, double *turned, const int *type, const int *direct, const int *shear) {
    static const int place[3][2] = {{0, 1}, {0, 2}, {1, 2}};
    double a[3][3], b[3][3];
    square(s, type, direct, shear, a);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            b[i][j] = 0.0;
            for (int k = 0; k < 3; k++)
                for (int l = 0; l < 3; l++) b[i][j] += r[i + 3 * k] * a[k][l] * r[j + 3 * l];
        }
    for (int i = 0; i < *direct; i++) turned[i] = b[i][i];
    for (int i = 0; i < *shear; i++)
        turned[*direct + i] = (*type == 2 ? 2.0 : 1.0) * b[place[i][0]][place[i][1]];
}

static void text(const char *value, char *out, int *length, size_t room) {
    size_t n = strlen(value);
    memset(out, ' ', room);
    memcpy(out, value, n < room ? n : room);
    *length = (int)(n < room ? n : room);
}
/* Where the process runs; the files beside the subroutine have been copied there. */
WEAK void getoutdir_(char *name, int *length, size_t room) {
    char here[4096];
    text(getcwd(here, sizeof here) ? here : ".", name, length, room);
}
WEAK void vgetoutdir_(char *name, int *length, size_t room) { getoutdir_(name, length, room); }
WEAK void getjobname_(char *name, int *length, size_t room) { text("check", name, length, room); }
WEAK void vgetjobname_(char *name, int *length, size_t room) { text("check", name, length, room); }
WEAK void getpartinfo_(const int *number, const int *type, char *name, int *local, int *error, size_t room) {
    int length;
    (void)type;
    text("PART-1", name, &length, room);
    *local = *number;
    *error = 0;
}
WEAK void getelemnumberuser_(const int *number, int *user) { *user = *number; }
WEAK int getnumcpus_(void) { return 1; }
WEAK int getnumthreads_(void) { return 1; }
WEAK int get_thread_id_(void) { return 0; }
WEAK int getthreadid_(void) { return 0; }
WEAK void getrank_(int *rank) { *rank = 0; }
WEAK void vgetrank_(int *rank) { *rank = 0; }
WEAK void getnumcpus_sub_(int *count) { *count = 1; }
WEAK void getcommunicator_(int *communicator) { *communicator = 0; }

/* Results of other points are not there: zeros, and an error code that says so. */
WEAK void getvrm_(const char *variable, double *values, char *flags, int *integers, int *error, const int *strategy,
                  const int *unused, const int *more, const int *layout, size_t length, size_t length_of_flags) {
    (void)variable, (void)flags, (void)integers, (void)strategy, (void)unused, (void)more, (void)layout, (void)length;
    (void)length_of_flags;
    memset(values, 0, 15 * sizeof(double));
    *error = 1;
}

enum { MUTEXES = 256 };
static pthread_mutex_t mutexes[MUTEXES];
static pthread_once_t once = PTHREAD_ONCE_INIT;
static void prepare(void) {
    pthread_mutexattr_t kind;
    pthread_mutexattr_init(&kind);
    pthread_mutexattr_settype(&kind, PTHREAD_MUTEX_RECURSIVE);
    for (int i = 0; i < MUTEXES; i++) pthread_mutex_init(&mutexes[i], &kind);
}
static pthread_mutex_t *mutex(const int *number) {
    pthread_once(&once, prepare);
    return &mutexes[(unsigned)*number % MUTEXES];
}
WEAK void mutexinit_(const int *number) { mutex(number); }
WEAK void mutexlock_(const int *number) { pthread_mutex_lock(mutex(number)); }
WEAK void mutexunlock_(const int *number) { pthread_mutex_unlock(mutex(number)); }
