/* The law of examples/own_law through its header: prepared, in blocks with everything that can be asked for, and refused. Reads the
 * number of points and each one's F by columns; prints each one's stress, state, tangent, wave speed, flag and status. */
#include "../c/check.h"

#include "reinforced.h"

#ifdef SINGLE
#define FORMAT "%.9g "
#define READ "%f"
#else
#define FORMAT "%.17g "
#define READ "%lf"
#endif

typedef ENTRY(REINFORCED) law;
typedef ENTRY(REINFORCED_points) points;

enum { PROPERTIES_OF_LAW = REINFORCED_PROPERTIES };
static const real properties[PROPERTIES_OF_LAW] = {31, 17, 230, (real)1.2, 2, -1, (real)0.5};

static void tables(void)
{
    CHECK(REINFORCED_property_count() == REINFORCED_PROPERTIES, "%d", REINFORCED_property_count());
    CHECK(REINFORCED_state_count() == REINFORCED_STATE, "%d", REINFORCED_state_count());
    char message[REINFORCED_MESSAGE_CAPACITY];
    REINFORCED_table_row row = {.size = sizeof row};
    CHECK(REINFORCED_property(REINFORCED_PROPERTY_STRETCH_LIM, &row, message, sizeof message) == 0, "%s", message);
    CHECK(strcmp(row.name, "stretch_lim") == 0 && row.has_default == 1 && row.default_value == 0, "%s", row.name);
    CHECK(REINFORCED_state_variable(REINFORCED_STATE_STRETCH, &row, message, sizeof message) == 0, "%s", message);
    CHECK(strcmp(row.name, "stretch") == 0 && strcmp(row.meaning, "stretch of the fibre") == 0, "%s", row.meaning);
    CHECK(REINFORCED_property(REINFORCED_PROPERTIES, &row, message, sizeof message) == REINFORCED_STATUS_UNKNOWN_NAME, "no error");
    CHECK(strstr(message, "index is 7; allowed: 0 to 6") != NULL, "%s", message);
    CHECK(REINFORCED_status_message(REINFORCED_STATUS_INVERTED, message, sizeof message) == 0, "%s", message);
    CHECK(strstr(message, "determinant") != NULL, "%s", message);
}

/* Nothing but the message is written where the call is wrong. */
#define WRONG(call, code, text)                                         \
    do {                                                                \
        message[0] = 0;                                                 \
        const int32_t status = call;                                    \
        CHECK(status == (code), "status %d", status);                   \
        CHECK(strstr(message, text) != NULL, "\"%s\" in %s", text, message); \
    } while (0)

static void refusals(void)
{
    char message[REINFORCED_MESSAGE_CAPACITY];
    const size_t room = sizeof message;
    real wrong[PROPERTIES_OF_LAW];
    memcpy(wrong, properties, sizeof wrong);
    law l;
    memset(&l, 7, sizeof l);
    const law untouched = l;
    wrong[REINFORCED_PROPERTY_MU] = -1;
    WRONG(ENTRY(REINFORCED_prepare)(&l, sizeof l, wrong, PROPERTIES_OF_LAW, message, room),
            REINFORCED_STATUS_PROPERTY_OUT_OF_BOUNDS, "property 1 (mu, shear modulus of the solid) is -1.0; allowed: ");
    WRONG(ENTRY(REINFORCED_prepare)(&l, sizeof l, properties, 6, message, room), REINFORCED_STATUS_PROPERTY_COUNT, "6 given, 7 needed");
    WRONG(ENTRY(REINFORCED_prepare)(&l, sizeof l - 8, properties, PROPERTIES_OF_LAW, message, room), REINFORCED_STATUS_BAD_SIZE,
            TEXT(ENTRY(REINFORCED)));
    CHECK(memcmp(&l, &untouched, sizeof l) == 0, "the law has been written");

    real f[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, stress[6], state[REINFORCED_STATE] = {0};
    points p = {.size = sizeof p, .n = 1, .f_new = {f}, .stress = {stress}, .state_old = state, .state_new = state};
    WRONG(ENTRY(REINFORCED_block)(&l, &p, message, room), REINFORCED_STATUS_NOT_PREPARED, TEXT(ENTRY(REINFORCED_prepare)));
    CHECK(ENTRY(REINFORCED_prepare)(&l, sizeof l, properties, PROPERTIES_OF_LAW, message, room) == 0, "%s", message);
    CHECK(ENTRY(REINFORCED_block)(&l, &p, message, room) == 0, "%s", message);
    CHECK(fabs((double)state[REINFORCED_STATE_STRETCH] - 1) <= ALLOWED && state[REINFORCED_STATE_ALIVE] == 1, "at rest");
    law cut = l;
    cut.values[sizeof cut.values / sizeof *cut.values - 1] = 0;
    WRONG(ENTRY(REINFORCED_block)(&cut, &p, message, room), REINFORCED_STATUS_NOT_PREPARED, "has not been prepared");
    p.size = 0;
    WRONG(ENTRY(REINFORCED_block)(&l, &p, message, room), REINFORCED_STATUS_BAD_SIZE, TEXT(ENTRY(REINFORCED_points)));
    p.size = sizeof p;
    p.f_new[0] = NULL;
    WRONG(ENTRY(REINFORCED_block)(&l, &p, message, room), REINFORCED_STATUS_NULL_ARGUMENT, "f_new");
    p.f_new[0] = f;
    p.level = 9;
    WRONG(ENTRY(REINFORCED_block)(&l, &p, message, room), REINFORCED_STATUS_BAD_ARGUMENT, "level is 9");
    p.level = 0;
    real speed;
    p.wave_speed = &speed;
    WRONG(ENTRY(REINFORCED_block)(&l, &p, message, room), REINFORCED_STATUS_BAD_ARGUMENT, "density is 0.0");
    p.wave_speed = NULL;
    int32_t status;
    p.status = &status;
    f[0] = -1;
    WRONG(ENTRY(REINFORCED_block)(&l, &p, message, room), REINFORCED_STATUS_INVERTED, "point 0");
    CHECK(status == REINFORCED_STATUS_INVERTED && stress[0] == 0, "%d", status);
    /* An older program's structure is shorter, and a newer one's longer, which must be 0 there. */
    f[0] = 1;
    struct {
        points p;
        size_t more;
    } longer = {p, 0};
    longer.p.size = sizeof longer;
    CHECK(ENTRY(REINFORCED_block)(&l, &longer.p, message, room) == 0, "%s", message);
    longer.more = 1;
    WRONG(ENTRY(REINFORCED_block)(&l, &longer.p, message, room), REINFORCED_STATUS_UNKNOWN_FIELD, "is not 0");
}

/* The points of the standard input, in arrays with a leading dimension of their own. */
static void block(void)
{
    size_t n;
    if (scanf("%zu", &n) != 1)
        exit(2);
    const size_t distance = n + 37;
    real *const f = calloc(9 * distance, sizeof *f), *const stress = calloc(6 * distance, sizeof *f);
    real *const state = calloc(REINFORCED_STATE * distance, sizeof *f), *const tangent = calloc(36 * distance, sizeof *f);
    real *const speed = calloc(n, sizeof *f), *const active = calloc(n, sizeof *f);
    int32_t *const status = calloc(n, sizeof *status);
    for (size_t i = 0; i < n; i++)
        for (size_t c = 0; c < 9; c++)
            if (scanf(READ, &f[c * distance + i]) != 1)
                exit(2);
    char message[REINFORCED_MESSAGE_CAPACITY];
    law l;
    CHECK(ENTRY(REINFORCED_prepare)(&l, sizeof l, properties, PROPERTIES_OF_LAW, message, sizeof message) == 0, "%s", message);
    const law copy = l;
    points p = {.size = sizeof p, .n = n, .leading_dimension = distance, .measure = REINFORCED_TANGENT_JAUMANN, .density = 1.5e-9,
                .f_new = {f}, .state_old = state, .state_new = state, .stress = {stress}, .tangent = tangent, .wave_speed = speed,
                .active = active, .status = status};
    ENTRY(REINFORCED_block)(&copy, &p, message, sizeof message);
    for (size_t i = 0; i < n; i++) {
        for (size_t c = 0; c < 6; c++)
            printf(FORMAT, stress[c * distance + i]);
        for (size_t c = 0; c < REINFORCED_STATE; c++)
            printf(FORMAT, state[c * distance + i]);
        for (size_t c = 0; c < 36; c++)
            printf(FORMAT, tangent[c * distance + i]);
        printf(FORMAT FORMAT "%d\n", speed[i], active[i], status[i]);
    }
}

int main(void)
{
    tables();
    refusals();
    block();
    return finish();
}
