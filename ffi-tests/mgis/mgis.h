/* A loader of behaviours that does what MGIS 3.1 and TFEL 5.1's MTest do: the same symbols, looked up by dlsym in the same way, with
 * the same requirements. The data of a call are laid out as in MGIS's BehaviourDataView. */
#ifndef MGIS_H
#define MGIS_H

#include <dlfcn.h>

#include "../c/check.h"

typedef struct {
    const double *gradients;
    double *thermodynamic_forces;
    const double *mass_density, *material_properties;
    double *internal_state_variables, *stored_energy, *dissipated_energy;
    const double *external_state_variables;
} state_view;

typedef struct {
    char *error_message;
    double dt;
    double *K, *rdt, *speed_of_sound;
    state_view s0, s1;
} data_view;

_Static_assert(sizeof(data_view) == 168, "the size of MGIS's BehaviourDataView");

typedef int (*integrate_function)(data_view *);

enum { MOST_NAMES = 16, HYPOTHESES = 3, BEHAVIOURS = 3 };
static const char *const hypotheses[HYPOTHESES] = {"Tridimensional", "PlaneStrain", "Axisymmetrical"};
static const char *const behaviours[BEHAVIOURS] = {"ToronHyperelastic", "ToronLinearElastic", "ToronFrictional"};

/* A list of variables, and their types where they have some. */
typedef struct {
    int count;
    const char *names[MOST_NAMES];
    int types[MOST_NAMES];
} variables;

typedef struct {
    const char *name, *hypothesis;
    integrate_function integrate;
    variables gradients, forces, properties, state, external, parameters, blocks;
    int stores_energy, dissipates_energy;
} behaviour;

/* ---- Symbols */

static void *library;
/* A symbol that is to be missing, or null; whether each symbol is printed that has to be there. */
static const char *hidden;
static int listing;

/* The address of a symbol, or null. A function's and a datum's address come from the same call of dlsym. */
static void *look_up(const char *name)
{
    return hidden != NULL && strcmp(name, hidden) == 0 ? NULL : dlsym(library, name);
}

/* BEHAVIOUR_REST. */
static const char *symbol(const behaviour *b, const char *rest)
{
    static char name[160];
    snprintf(name, sizeof name, "%s_%s", b->name, rest);
    return name;
}

/* BEHAVIOUR_HYPOTHESIS_REST or, if there is none, BEHAVIOUR_REST: null if there is neither. */
static void *optional(const behaviour *b, const char *rest)
{
    char name[160];
    snprintf(name, sizeof name, "%s_%s_%s", b->name, b->hypothesis, rest);
    void *found = look_up(name);
    return found != NULL ? found : look_up(symbol(b, rest));
}

/* The same for a symbol without which a behaviour is not loaded. */
static void *required(const behaviour *b, const char *rest)
{
    void *found = optional(b, rest);
    if (found == NULL) {
        fprintf(stderr, "%s: no symbol %s\n", b->name, symbol(b, rest));
        exit(1);
    }
    if (listing)
        puts(symbol(b, rest));
    return found;
}

static int number(const behaviour *b, const char *rest)
{
    return *(const unsigned short *)required(b, rest);
}

static const char *text_of(const behaviour *b, const char *rest)
{
    return *(const char *const *)required(b, rest);
}

static void expect(const behaviour *b, int right, const char *what)
{
    if (!right) {
        fprintf(stderr, "%s: %s\n", b->name, what);
        exit(1);
    }
}

/* A list that has a count, names where there are any, and types if `typed`. */
static void read_list(const behaviour *b, const char *name, int typed, variables *to)
{
    char counted[64], types[64];
    snprintf(counted, sizeof counted, "n%s", name);
    snprintf(types, sizeof types, "%sTypes", name);
    to->count = number(b, counted);
    expect(b, to->count <= MOST_NAMES, "more names than there is room for");
    const char *const *names = to->count > 0 ? required(b, name) : NULL;
    const int *kinds = typed ? required(b, types) : NULL;
    for (int i = 0; i < to->count; i++) {
        to->names[i] = names[i];
        to->types[i] = typed ? kinds[i] : 0;
        expect(b, names[i] != NULL && names[i][0] != '\0', "an empty name");
    }
}

static int is_one(const variables *list, const char *name, int type)
{
    return list->count == 1 && strcmp(list->names[0], name) == 0 && list->types[0] == type;
}

enum { SCALAR, SYMMETRIC, VECTOR, TENSOR };

/* ---- What MGIS does. */

static behaviour load(const char *name, const char *hypothesis)
{
    behaviour b = {.name = name, .hypothesis = hypothesis};
    void *function = required(&b, hypothesis);
    memcpy(&b.integrate, &function, sizeof function); /* ISO C has no conversion from a datum's to a function's pointer */
    expect(&b, number(&b, "mfront_mkt") == 1, "not a behaviour");
    expect(&b, number(&b, "api_version") == 1, "another version of the interface");
    expect(&b, number(&b, "BehaviourType") == 2, "not a behaviour of finite strain");
    expect(&b, number(&b, "BehaviourKinematic") == 3, "not from F to the Cauchy stress");
    expect(&b, number(&b, "SymmetryType") == 0, "orthotropic, and then there are functions that rotate");
    read_list(&b, "Gradients", 1, &b.gradients);
    read_list(&b, "ThermodynamicForces", 1, &b.forces);
    expect(&b, is_one(&b.gradients, "DeformationGradient", TENSOR), "the gradient is not F");
    expect(&b, is_one(&b.forces, "Stress", SYMMETRIC), "the force is not the stress");
    expect(&b, number(&b, "requiresStiffnessTensor") == 0, "it needs a stiffness tensor");
    expect(&b, number(&b, "requiresThermalExpansionCoefficientTensor") == 0, "it needs a thermal expansion");
    read_list(&b, "MaterialProperties", 0, &b.properties);
    read_list(&b, "InternalStateVariables", 1, &b.state);
    read_list(&b, "ExternalStateVariables", 0, &b.external);
    read_list(&b, "TangentOperatorBlocks", 0, &b.blocks);
    expect(&b, b.blocks.count == 2 && strcmp(b.blocks.names[0], "Stress") == 0
               && strcmp(b.blocks.names[1], "DeformationGradient") == 0, "not the block of the stress by F");
    b.stores_energy = number(&b, "ComputesInternalEnergy");
    b.dissipates_energy = number(&b, "ComputesDissipatedEnergy");
    read_list(&b, "Parameters", 1, &b.parameters);
    expect(&b, number(&b, "nInitializeFunctions") == 0, "it has initialize functions");
    expect(&b, number(&b, "nPostProcessings") == 0, "it has post-processings");
    for (int i = 0; i < b.state.count; i++)
        expect(&b, b.state.types[i] == SCALAR, "a state variable that is no scalar");
    return b;
}

/* What MTest looks up besides. */
static inline behaviour load_as_mtest(const char *name, const char *hypothesis)
{
    behaviour b = load(name, hypothesis);
    expect(&b, strcmp(text_of(&b, "mfront_interface"), "Generic") == 0, "not the generic interface");
    int count = number(&b, "nModellingHypotheses"), found = 0;
    const char *const *names = required(&b, "ModellingHypotheses");
    for (int i = 0; i < count; i++)
        found |= strcmp(names[i], hypothesis) == 0;
    expect(&b, found, "not one of its hypotheses");
    expect(&b, number(&b, "ElasticSymmetryType") == 0, "orthotropic");
    expect(&b, number(&b, "TemperatureRemovedFromExternalStateVariables") == 1, "the temperature is among the variables");
    required(&b, "ExternalStateVariablesTypes");
    required(&b, "ExternalStateVariables");
    /* Not every deck has @OutOfBoundsPolicy; TFEL's type of the function returns an int that nobody reads. */
    void *function = required(&b, "setOutOfBoundsPolicy");
    void (*set_policy)(int);
    memcpy(&set_policy, &function, sizeof function);
    for (int policy = 0; policy < 3; policy++)
        set_policy(policy);
    required(&b, "MaterialProperties");
    required(&b, "Parameters");
    return b;
}

static void open_library(const char *path)
{
    library = dlopen(path, RTLD_NOW);
    if (library == NULL) {
        fprintf(stderr, "%s\n", dlerror());
        exit(1);
    }
}

#endif
