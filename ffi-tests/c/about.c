/* The library about itself: version, messages, tables, presets, and the check of properties. */
#include "check.h"

static void version(void)
{
    CHECK(toron_abi_version() == TORON_ABI_VERSION, "%d", toron_abi_version());
    CHECK(strcmp(toron_version(), EXPECTED_VERSION) == 0, "%s", toron_version());
}

/* snprintf's semantics: the length needed whatever the room, always terminated, not a byte beyond. */
static void messages(void)
{
    const char *whole = "an argument that must not be null is null";
    const size_t length = strlen(whole);
    CHECK(toron_status_message(TORON_NULL_ARGUMENT, NULL, 0) == length, "no buffer");
    CHECK(toron_status_message(TORON_NULL_ARGUMENT, NULL, 10) == length, "no buffer, whatever the capacity");
    for (size_t capacity = 0; capacity <= length + 2; capacity++) {
        char *buffer = guarded(length + 2);
        CHECK(toron_status_message(TORON_NULL_ARGUMENT, buffer, capacity) == length, "capacity %zu", capacity);
        size_t written = capacity == 0 ? 0 : (capacity <= length ? capacity : length + 1);
        if (capacity > 0) {
            CHECK(strlen(buffer) == written - 1, "capacity %zu", capacity);
            CHECK(strncmp(buffer, whole, written - 1) == 0, "capacity %zu", capacity);
        }
        CHECK(untouched(buffer + written, length + 2 - written), "capacity %zu", capacity);
        release();
    }
    const int32_t codes[] = {TORON_OK, TORON_NULL_ARGUMENT, TORON_BAD_COUNT, TORON_BAD_LEADING_DIMENSION,
                             TORON_UNKNOWN_NAME, TORON_BAD_ARGUMENT, TORON_NO_DEFORMATION_GRADIENT,
                             TORON_PROPERTY_COUNT, TORON_PROPERTY_NOT_FINITE, TORON_PROPERTY_OUT_OF_BOUNDS,
                             TORON_PROPERTY_DIRECTION, TORON_STATE_COUNT, TORON_INVERTED, TORON_NOT_FINITE,
                             TORON_OVERFLOW, TORON_STATE_NOT_FINITE, TORON_FIBRE_DIRECTION, TORON_INCREMENT_TOO_LARGE};
    char text[200];
    for (size_t i = 0; i < sizeof codes / sizeof *codes; i++) {
        toron_status_message(codes[i], text, sizeof text);
        CHECK(strstr(text, "no such") == NULL || codes[i] == TORON_UNKNOWN_NAME, "%d: %s", codes[i], text);
    }
    toron_status_message(-2147483647 - 1, text, sizeof text);
    CHECK(strcmp(text, "no such status code: -2147483648") == 0, "%s", text);
}

static void check_tables(int32_t law, int32_t properties, int32_t state)
{
    CHECK(toron_property_count(law) == properties, "law %d", law);
    CHECK(toron_state_count(law) == state, "law %d", law);
    for (int32_t i = 0; i < properties; i++) {
        toron_table_row *row = guarded(sizeof *row);
        CHECK(toron_property(law, i, row) == TORON_OK, "law %d, property %d", law, i);
        CHECK(toron_property_index(law, row->name) == i, "law %d, property %s", law, row->name);
        CHECK(strlen(row->meaning) > 0 && strlen(row->allowed) > 0, "law %d, property %d", law, i);
        release();
    }
    for (int32_t i = 0; i < state; i++) {
        toron_table_row *row = guarded(sizeof *row);
        CHECK(toron_state_variable(law, i, row) == TORON_OK, "law %d, state variable %d", law, i);
        CHECK(toron_state_index(law, row->name) == i, "law %d, state variable %s", law, row->name);
        CHECK(row->default_value == 0 && row->has_default == 1, "state variables start at 0");
        release();
    }
    toron_table_row *row = guarded(sizeof *row);
    const int32_t outside[] = {-1, properties, 1000000};
    for (int i = 0; i < 3; i++) {
        CHECK(toron_property(law, outside[i], row) == TORON_UNKNOWN_NAME, "property %d", outside[i]);
        CHECK(toron_state_variable(law, outside[i] == properties ? state : outside[i], row) == TORON_UNKNOWN_NAME,
              "state variable %d", outside[i]);
    }
    CHECK(untouched(row, sizeof *row), "nothing is written");
    CHECK(toron_property(law, 0, NULL) == TORON_NULL_ARGUMENT, "no row");
    CHECK(toron_state_variable(law, 0, NULL) == TORON_NULL_ARGUMENT, "no row");
    const char *unknown[] = {NULL, "", "K_EL", "nothing",
                             "a name that is longer than any name of any table and goes on and on and on"};
    for (int i = 0; i < 5; i++) {
        CHECK(toron_property_index(law, unknown[i]) == TORON_UNKNOWN_NAME, "name %d", i);
        CHECK(toron_state_index(law, unknown[i]) == TORON_UNKNOWN_NAME, "name %d", i);
    }
    release();
}

static void tables(void)
{
    check_tables(TORON_HYPERELASTIC, TORON_HYPERELASTIC_PROPERTIES, TORON_HYPERELASTIC_STATE);
    check_tables(TORON_LINEAR_ELASTIC, TORON_LINEAR_ELASTIC_PROPERTIES, TORON_LINEAR_ELASTIC_STATE);
    CHECK(toron_property_count(2) == TORON_UNKNOWN_NAME && toron_state_count(-1) == TORON_UNKNOWN_NAME, "no such law");
    toron_table_row row;
    toron_property(TORON_HYPERELASTIC, 2, &row);
    CHECK(strcmp(row.name, "p") == 0 && row.minimum == 1 && row.minimum_excluded == 1 && row.maximum == 40 && row.has_default == 0, "p");
    CHECK(strcmp(row.allowed, "a number > 1, at most 40") == 0, "%s", row.allowed);
    toron_property(TORON_HYPERELASTIC, toron_property_index(TORON_HYPERELASTIC, "k_el"), &row);
    CHECK(strcmp(row.unit, "stress") == 0 && row.mass == 1 && row.length == -1 && row.time == -2, "%s", row.unit);
    CHECK(toron_state_index(TORON_HYPERELASTIC, "w_el") == ENERGIES, "w_el");
    CHECK(toron_state_index(TORON_HYPERELASTIC, "i_el") == INVARIANTS, "i_el");
    CHECK(toron_state_index(TORON_HYPERELASTIC, "failed") == FAILED, "failed");
    CHECK(toron_state_index(TORON_HYPERELASTIC, "alive") == ALIVE, "alive");
    CHECK(toron_state_variable(TORON_HYPERELASTIC, ALIVE, &row) == TORON_OK, "alive");
}

static int close_to(double a, double b)
{
    return fabs(a - b) <= 4e-16 * fabs(b);
}

static void presets(void)
{
    const struct { const char *units; double stress, density; } all[] = {
        {"m-kg-s", 82.341e9, 1351.4}, {"mm-tonne-s", 82341, 1.3514e-9}, {"mm-kg-ms", 82.341, 1.3514e-6},
        {"cm-g-us", 0.82341, 1.3514}, {"si", 82.341e9, 1351.4}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        double *values = guarded(PROPERTIES * sizeof *values), *density = guarded(sizeof *density);
        float *single = guarded(PROPERTIES * sizeof *single), *single_density = guarded(sizeof *single_density);
        int32_t status = toron_preset_f64("kevlar-km2-600", all[i].units, values, PROPERTIES, density);
        CHECK(status == TORON_OK, "%s: %d", all[i].units, status);
        CHECK(close_to(values[0], all[i].stress), "%s: k_el is %.17g", all[i].units, values[0]);
        CHECK(close_to(*density, all[i].density), "%s: the density is %.17g", all[i].units, *density);
        CHECK(close_to(values[2], 2.2) && close_to(values[5], 0.0458), "numbers have no unit");
        CHECK(toron_hyperelastic_validate_f64(values, PROPERTIES, NULL, 0, NULL) == 0, "%s", all[i].units);
        status = toron_preset_f32("kevlar-km2-600", all[i].units, single, PROPERTIES, single_density);
        CHECK(status == TORON_OK && *single_density == (float)*density, "%s: %d", all[i].units, status);
        for (int k = 0; k < PROPERTIES; k++)
            CHECK(single[k] == (float)values[k], "%s: property %d", all[i].units, k);
        release();
    }
    enum { LINEAR = TORON_LINEAR_ELASTIC_PROPERTIES };
    double *values = guarded(PROPERTIES * sizeof *values);
    CHECK(toron_preset_f64("nylon", "si", values, PROPERTIES, NULL) == TORON_UNKNOWN_NAME, "preset");
    CHECK(toron_preset_f64(NULL, "si", values, PROPERTIES, NULL) == TORON_UNKNOWN_NAME, "preset");
    CHECK(toron_preset_f64("kevlar-km2-600", "m-kg", values, PROPERTIES, NULL) == TORON_UNKNOWN_NAME, "units");
    CHECK(toron_preset_f64("kevlar-km2-600", NULL, values, PROPERTIES, NULL) == TORON_UNKNOWN_NAME, "units");
    CHECK(toron_preset_f64("kevlar-km2-600", "si", values, LINEAR, NULL) == TORON_PROPERTY_COUNT, "count");
    CHECK(toron_preset_f64("kevlar-km2-600", "si", NULL, PROPERTIES, NULL) == TORON_NULL_ARGUMENT, "no room");
    CHECK(toron_preset_f32("kevlar-km2-600", "si", NULL, PROPERTIES, NULL) == TORON_NULL_ARGUMENT, "no room");
    CHECK(toron_preset_f32("kevlar-km2-600", "si", (float *)values, 1000, NULL) == TORON_PROPERTY_COUNT, "count");
    CHECK(untouched(values, PROPERTIES * sizeof *values), "nothing is written");
    CHECK(toron_preset_f64("kevlar-km2-600-linear", "mm-kg-ms", values, LINEAR, NULL) == TORON_OK, "linear");
    CHECK(close_to(values[0], 79.414), "E1 is %.17g", values[0]);
    CHECK(toron_linear_elastic_validate_f64(values, LINEAR, NULL, 0, NULL) == 0, "linear");
    release();
}

static void check_message(const real *values, size_t count, int32_t wanted, const char *text)
{
    char *message = guarded(200);
    int32_t *status = guarded(sizeof *status);
    size_t length = ENTRY(toron_hyperelastic_validate)(values, count, message, 200, status);
    CHECK(*status == wanted, "%d: %s", *status, message);
    CHECK(strcmp(message, text) == 0, "%s", message);
    CHECK(length == strlen(text), "%zu", length);
    CHECK(ENTRY(toron_hyperelastic_validate)(values, count, NULL, 0, NULL) == length, "without a buffer");
    /* An exact fit, and one too few. */
    memset(message, PATTERN, 200);
    ENTRY(toron_hyperelastic_validate)(values, count, message, length + 1, NULL);
    CHECK(strcmp(message, text) == 0 && untouched(message + length + 1, 199 - length), "%s", message);
    if (length > 0) {
        ENTRY(toron_hyperelastic_validate)(values, count, message, length, NULL);
        CHECK(strlen(message) == length - 1 && strncmp(message, text, length - 1) == 0, "%s", message);
    }
    release();
}

static void properties(void)
{
    real good[PROPERTIES], bad[PROPERTIES];
    ENTRY(toron_preset)("kevlar-km2-600", "si", good, PROPERTIES, NULL);
    check_message(good, PROPERTIES, TORON_OK, "");
    check_message(NULL, PROPERTIES, TORON_NULL_ARGUMENT, "an argument that must not be null is null");
    check_message(good, 10, TORON_PROPERTY_COUNT, "number of properties: 10 given, 11 needed");
    check_message(good, 0, TORON_PROPERTY_COUNT, "number of properties: 0 given, 11 needed");
    check_message(good, 1000, TORON_PROPERTY_COUNT, "number of properties: 1000 given, 11 needed");
    memcpy(bad, good, sizeof bad);
    bad[2] = 0.5;
    check_message(bad, PROPERTIES, TORON_PROPERTY_OUT_OF_BOUNDS,
                  "property 3 (p, transverse compaction exponent) is 0.5; allowed: a number > 1, at most 40");
    bad[0] = NAN;
    check_message(bad, PROPERTIES, TORON_PROPERTY_NOT_FINITE,
                  "property 1 (k_el, longitudinal elongation stiffness) is NaN; allowed: a number from 0 to 1e25");
    bad[0] = -INFINITY;
    check_message(bad, PROPERTIES, TORON_PROPERTY_NOT_FINITE,
                  "property 1 (k_el, longitudinal elongation stiffness) is -infinity; allowed: a number from 0 to 1e25");
    memcpy(bad, good, sizeof bad);
    bad[8] = bad[9] = bad[10] = 0;
    check_message(bad, PROPERTIES, TORON_PROPERTY_DIRECTION,
                  "properties 9 to 11 (fibre direction) are 0.0, 0.0, 0.0; allowed: any vector but zero");
}

int main(void)
{
    version();
    messages();
    tables();
    presets();
    properties();
    return finish();
}
