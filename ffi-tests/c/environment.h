/* Calls an entry in many floating-point environments, and compares each call with the one in the default environment. */
#ifndef ENVIRONMENT_H
#define ENVIRONMENT_H

#include <fenv.h>
#include <immintrin.h>
#include <signal.h>
#include <ucontext.h>

#include "check.h"

/* MXCSR, the register of SSE and AVX: flags of exceptions, subnormal inputs taken as zero (DAZ), masks of exceptions, rounding,
 * subnormal results flushed to zero (FTZ). Masks are set where an exception does not trap. */
enum {
    INVALID = 0x01, SUBNORMAL_INPUT = 0x02, DIVISION_BY_ZERO = 0x04, OVERFLOWED = 0x08, UNDERFLOWED = 0x10, INEXACT = 0x20,
    FLAGS = 0x3f, DAZ = 0x40, MASKS = 0x1f80, DOWN = 0x2000, UP = 0x4000, TO_ZERO = 0x6000, FTZ = 0x8000,
    TRAPS_OF_SOLVERS = (INVALID | DIVISION_BY_ZERO | OVERFLOWED) << 7,
};

/* An environment: MXCSR, and the control word of the x87 registers as a solver's Fortran would set it. */
typedef struct {
    const char *name;
    unsigned mxcsr;
    unsigned short x87;
} environment;

/* What a process starts with comes first: the others must give the same. */
static const environment environments[] = {
    {"default", MASKS, 0x37f},
    {"all flags raised", MASKS | FLAGS, 0x37f},
    {"all exceptions trapped", 0, 0x340},
    {"all exceptions trapped, all flags raised", FLAGS, 0x340},
    {"invalid, division by zero, overflow trapped", MASKS & ~TRAPS_OF_SOLVERS, 0x372},
    {"subnormal numbers flushed", MASKS | FTZ | DAZ, 0x37f},
    {"round down", MASKS | DOWN, 0x77f},
    {"round up", MASKS | UP, 0xb7f},
    {"round to zero", MASKS | TO_ZERO, 0xf7f},
    {"trapped, flushed, round up, flags raised", FLAGS | FTZ | DAZ | UP, 0xb40},
};
enum { TRAPPING_SOLVER = 4, ENVIRONMENTS = sizeof environments / sizeof *environments };

static void set_environment(const environment *e)
{
    __asm__ volatile("fldcw %0" : : "m"(e->x87));
    _mm_setcsr(e->mxcsr);
}

/* How many of them are run. */
static size_t environment_count = ENVIRONMENTS;

/* ---- What went wrong, for each entry and environment: how often, and the first time. */

enum { TRAPPED, DIFFERENT, MXCSR_CHANGED, X87_CHANGED, KINDS, MOST_ENTRIES = 96 };
static const char *const kinds[KINDS] = {"SIGFPE", "different bits", "flags changed", "x87 changed"};

static struct {
    const char *name;
    int calls;
    struct {
        int count;
        char first[240];
    } faults[ENVIRONMENTS][KINDS];
} entries[MOST_ENTRIES];
/* The entry that is being called, and what with, in words. */
static int entry = -1;
static char arguments[160];
#define ARGUMENTS(...) snprintf(arguments, sizeof arguments, __VA_ARGS__)

static void fault(size_t where, int kind, const char *what)
{
    char *first = entries[entry].faults[where][kind].first;
    if (entries[entry].faults[where][kind].count++ == 0)
        snprintf(first, sizeof entries->faults[0][0].first, "%s; %s", arguments, what);
}

/* Prints what went wrong, one line for each entry, environment and kind, and counts the lines as failures. */
static void report(void)
{
    for (int i = 0; i <= entry; i++) {
        CHECK(entries[i].calls > 0, "%s is never called", entries[i].name);
        for (size_t e = 0; e < ENVIRONMENTS; e++)
            for (int kind = 0; kind < KINDS; kind++)
                if (entries[i].faults[e][kind].count > 0) {
                    failures++;
                    printf("%s: %s: %s in %d of %d calls; first: %s\n", entries[i].name, environments[e].name, kinds[kind],
                           entries[i].faults[e][kind].count, entries[i].calls, entries[i].faults[e][kind].first);
                }
    }
}

/* ---- SIGFPE. The handler masks all exceptions and lets the instruction run again, so that the call comes to its end. */

static volatile sig_atomic_t trap; /* si_code of the first one in this call */

static void on_trap(int signal, siginfo_t *information, void *context)
{
    fpregset_t registers = ((ucontext_t *)context)->uc_mcontext.fpregs;
    (void)signal;
    if (trap == 0)
        trap = information->si_code;
    registers->mxcsr |= MASKS;
    registers->cwd |= 0x3f;
}

static const char *trap_name(void)
{
    switch (trap) {
    case FPE_FLTINV: return "INVALID";
    case FPE_FLTDIV: return "DIVBYZERO";
    case FPE_FLTOVF: return "OVERFLOW";
    case FPE_FLTUND: return "UNDERFLOW or DENORMAL";
    case FPE_FLTRES: return "PRECISION";
    default: return "unknown";
    }
}

static void start(void)
{
    struct sigaction action = {.sa_sigaction = on_trap, .sa_flags = SA_SIGINFO};
    sigaction(SIGFPE, &action, NULL);
    /* What a solver does that traps. */
    set_environment(&environments[0]);
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
    if (environment_count > TRAPPING_SOLVER)
        CHECK(_mm_getcsr() == environments[TRAPPING_SOLVER].mxcsr, "%#06x", _mm_getcsr());
    fedisableexcept(FE_ALL_EXCEPT);
    /* The x87 registers are empty, and hold bits that whoever used them would change. */
    __asm__ volatile("fninit");
    for (int i = 0; i < 8; i++)
        __asm__ volatile("fldpi; ffree %st(0)");
}

/* ---- One call after the other, on the same arrays, with the same buffer for a message. */

#define MESSAGE text, TORON_MESSAGE_CAPACITY

enum { MOST_BYTES = 1 << 20 };

static unsigned char image[MOST_BYTES], reference[MOST_BYTES]; /* the arrays before any call, and after the first one */
static char first_text[sizeof text];
static int64_t answer, first_answer;
static size_t where;
/* All x87 registers, control and status words, and MXCSR, as FXSAVE writes them. */
static _Alignas(16) unsigned char before[512], after[512];

static void copy_arrays(unsigned char *to)
{
    for (int i = 0; i < array_count; i++) {
        memcpy(to, arrays[i].start + GUARD, arrays[i].bytes);
        to += arrays[i].bytes;
    }
}

static void put_arrays_back(void)
{
    const unsigned char *from = image;
    for (int i = 0; i < array_count; i++) {
        memcpy(arrays[i].start + GUARD, from, arrays[i].bytes);
        from += arrays[i].bytes;
    }
}

/* ---- What the calls of an entry give back in the default environment, as one number (FNV-1a): those at the
 * baseline, which every processor has and whose last digits are its own, apart from the others. */

static struct {
    uint64_t sum;
    int calls;
} answers[MOST_ENTRIES][2];
static int at_baseline;
/* Whether they are wanted, and the entry whose sum is printed after each call: what differs between two libraries
 * is found by it. */
static int sums_wanted;
static const char *traced = "";

/* The level that the next calls ask for. */
static int32_t at_level(int32_t level)
{
    at_baseline = level == TORON_LEVEL_BASELINE;
    return level;
}

static void add(const void *start, size_t bytes)
{
    uint64_t sum = answers[entry][at_baseline].sum;
    for (size_t i = 0; i < bytes; i++)
        sum = (sum ^ ((const unsigned char *)start)[i]) * 0x100000001b3;
    answers[entry][at_baseline].sum = sum;
}

/* Status, message and arrays. */
static void add_answer(void)
{
    if (answers[entry][at_baseline].calls++ == 0)
        answers[entry][at_baseline].sum = 0xcbf29ce484222325;
    add(&answer, sizeof answer);
    add(text, sizeof text);
    for (int i = 0; i < array_count; i++)
        if (!arrays[i].opaque)
            add(arrays[i].start + GUARD, arrays[i].bytes);
    if (strcmp(traced, entries[entry].name) == 0)
        printf("%d, %s: %016llx, status %lld\n", entries[entry].calls, arguments,
               (unsigned long long)answers[entry][at_baseline].sum, (long long)answer);
}

static void print_sums(void)
{
    static const char *const levels[2] = {"best", "baseline"};
    for (int i = 0; i <= entry; i++)
        for (int k = 0; k < 2; k++)
            if (answers[i][k].calls > 0)
                printf("%-50s %-8s %6d %016llx\n", entries[i].name, levels[k], answers[i][k].calls,
                       (unsigned long long)answers[i][k].sum);
}

static void begin(const char *call)
{
    size_t bytes = 0, length = strlen(entries[entry].name);
    for (int i = 0; i < array_count; i++)
        bytes += arrays[i].bytes;
    if (bytes > MOST_BYTES || strncmp(call, entries[entry].name, length) != 0 || call[length] != '(') {
        fprintf(stderr, "%s: not a call of %s, or its arrays are too large\n", call, entries[entry].name);
        exit(2);
    }
    entries[entry].calls++;
    copy_arrays(image);
}

static void enter(void)
{
    put_arrays_back();
    fresh_text();
    trap = 0;
    set_environment(&environments[where]);
    _fxsave64(before);
}

/* Status, message and arrays, those bytes included that no one writes, against those of the first call. */
static void compare(void)
{
    const unsigned char *wanted = reference;
    char what[80] = "";
    UNCHECKED_BEGIN;
    for (int i = 0; i < array_count; i++) {
        if (memcmp(arrays[i].start + GUARD, wanted, arrays[i].bytes) != 0)
            snprintf(what, sizeof what, "array %d, of %zu bytes", i, arrays[i].bytes);
        wanted += arrays[i].bytes;
    }
    UNCHECKED_END;
    if (memcmp(text, first_text, sizeof text) != 0)
        snprintf(what, sizeof what, "message %.60s", text);
    if (answer != first_answer)
        snprintf(what, sizeof what, "status %lld instead of %lld", (long long)answer, (long long)first_answer);
    if (what[0] != '\0')
        fault(where, DIFFERENT, what);
}

/* Back to the default environment; what the call did to the one it came from, and whether its results are the first's. */
static void leave(void)
{
    enum { MXCSR = 24, MXCSR_END = 32, X87_END = 160 };
    _fxsave64(after);
    set_environment(&environments[0]);
    if (where == 0) {
        first_answer = answer;
        memcpy(first_text, text, sizeof text);
        copy_arrays(reference);
        if (sums_wanted)
            add_answer();
    }
    if (trap != 0) {
        fault(where, TRAPPED, trap_name());
    } else {
        unsigned was, is;
        memcpy(&was, before + MXCSR, sizeof was);
        memcpy(&is, after + MXCSR, sizeof is);
        if (was != environments[where].mxcsr || is != was) {
            char what[80];
            snprintf(what, sizeof what, "MXCSR was %#06x, is %#06x", was, is);
            fault(where, MXCSR_CHANGED, what);
        }
        if (memcmp(before, after, MXCSR) != 0 || memcmp(before + MXCSR_END, after + MXCSR_END, X87_END - MXCSR_END) != 0)
            fault(where, X87_CHANGED, "control, status or a register");
        compare();
    }
}

/* Runs a statement, which is the call of the current entry, in every environment. Its arguments are in memory, and nothing
 * but the call computes. Afterwards the arrays are as they were. */
#define RUN(call, ...)                                          \
    do {                                                        \
        begin(call);                                            \
        for (where = 0; where < environment_count; where++) {   \
            enter();                                            \
            __VA_ARGS__;                                        \
            leave();                                            \
        }                                                       \
        put_arrays_back();                                      \
    } while (0)
/* Calls an entry that returns a status or a length. */
#define CALL(...) CALL_AS(__VA_ARGS__)
#define CALL_AS(...) RUN(#__VA_ARGS__, answer = (int64_t)(__VA_ARGS__))

#endif
