/* The library about itself: version, messages, tables, presets, and the check of properties. */
#include "check.h"

static void version(void)
{
    CHECK(toron_abi_version() == TORON_ABI_VERSION, "%d", toron_abi_version());
    CHECK(strcmp(toron_version(), EXPECTED_VERSION) == 0, "%s", toron_version());
}

/* As much of a message as fits, always terminated, not a byte beyond. */
static void messages(void)
{
    const char *whole = "an argument that must not be null is null";
    const size_t length = strlen(whole);
    CHECK(toron_status_message(TORON_NULL_ARGUMENT, NULL, 0) == TORON_OK, "no buffer");
    CHECK(toron_status_message(TORON_NULL_ARGUMENT, NULL, 10) == TORON_OK, "no buffer, whatever the capacity");
    for (size_t capacity = 0; capacity <= length + 2; capacity++) {
        char *buffer = guarded(length + 2);
        CHECK(toron_status_message(TORON_NULL_ARGUMENT, buffer, capacity) == TORON_OK, "capacity %zu", capacity);
        size_t written = capacity == 0 ? 0 : (capacity <= length ? capacity : length + 1);
        if (capacity > 0) {
            CHECK(strlen(buffer) == written - 1, "capacity %zu", capacity);
            CHECK(strncmp(buffer, whole, written - 1) == 0, "capacity %zu", capacity);
        }
        CHECK(untouched(buffer + written, length + 2 - written), "capacity %zu", capacity);
        release();
    }
    const int32_t codes[] = {TORON_OK, TORON_NULL_ARGUMENT, TORON_BAD_COUNT, TORON_BAD_LEADING_DIMENSION,
                             TORON_UNKNOWN_NAME, TORON_BAD_ARGUMENT, TORON_NO_DEFORMATION_GRADIENT, TORON_NOT_PREPARED,
                             TORON_BAD_SIZE, TORON_UNKNOWN_FIELD, TORON_PROPERTY_COUNT, TORON_PROPERTY_NOT_FINITE,
                             TORON_PROPERTY_OUT_OF_BOUNDS, TORON_PROPERTY_DIRECTION, TORON_FIBRE_OUT_OF_PLANE,
                             TORON_STATE_COUNT, TORON_INVERTED, TORON_NOT_FINITE, TORON_OVERFLOW,
                             TORON_STATE_NOT_FINITE, TORON_FIBRE_DIRECTION, TORON_INCREMENT_TOO_LARGE, TORON_MATERIAL_AXES,
                             TORON_LIMIT, TORON_LAW, TORON_SMALLER_STEP};
    for (size_t i = 0; i < sizeof codes / sizeof *codes; i++) {
        CHECK(toron_status_message(codes[i], text, sizeof text) == TORON_OK, "%d", codes[i]);
        CHECK(strstr(text, "no such") == NULL || codes[i] == TORON_UNKNOWN_NAME, "%d: %s", codes[i], text);
    }
    REFUSED(TORON_UNKNOWN_NAME, "no such status code: -2147483648", toron_status_message, -2147483647 - 1);
    REFUSED(TORON_UNKNOWN_NAME, "no such status code: 1", toron_status_message, 1);
}

/* A row to be filled in. */
static toron_table_row *new_row(void)
{
    toron_table_row *row = guarded(sizeof *row);
    row->size = sizeof *row;
    return row;
}

static void check_tables(int32_t law, int32_t properties, int32_t state)
{
    CHECK(TOLD(toron_property_count, law) == properties, "law %d", law);
    CHECK(TOLD(toron_state_count, law) == state, "law %d", law);
    for (int32_t i = 0; i < properties; i++) {
        toron_table_row *row = new_row();
        CHECK(TOLD(toron_property, law, i, row) == TORON_OK && row->size == sizeof *row, "law %d, property %d", law, i);
        CHECK(TOLD(toron_property_index, law, row->name) == i, "law %d, property %s", law, row->name);
        CHECK(strlen(row->meaning) > 0 && strlen(row->allowed) > 0, "law %d, property %d", law, i);
        release();
    }
    for (int32_t i = 0; i < state; i++) {
        toron_table_row *row = new_row();
        CHECK(TOLD(toron_state_variable, law, i, row) == TORON_OK && row->size == sizeof *row, "law %d, state variable %d", law, i);
        CHECK(TOLD(toron_state_index, law, row->name) == i, "law %d, state variable %s", law, row->name);
        CHECK(row->default_value == 0 && row->has_default == 1, "state variables start at 0");
        release();
    }
    toron_table_row *row = new_row();
    const int32_t outside[] = {-1, properties, 1000000};
    char expected[200];
    for (int i = 0; i < 3; i++) {
        snprintf(expected, sizeof expected, "argument index is %d; allowed: 0 to %d", outside[i], properties - 1);
        REFUSED(TORON_UNKNOWN_NAME, expected, toron_property, law, outside[i], row);
        int32_t index = outside[i] == properties ? state : outside[i];
        snprintf(expected, sizeof expected, "argument index is %d; allowed: 0 to %d", index, state - 1);
        REFUSED(TORON_UNKNOWN_NAME, expected, toron_state_variable, law, index, row);
    }
    CHECK(untouched(row->name, sizeof *row - sizeof row->size), "nothing is written");
    REFUSED(TORON_NULL_ARGUMENT, "argument row is null", toron_property, law, 0, NULL);
    REFUSED(TORON_NULL_ARGUMENT, "argument row is null", toron_state_variable, law, 0, NULL);
    const char *unknown[] = {"", "K_EL", "nothing", "a name that is longer than any name of any table and goes on and on and on",
                             "not UTF-8: \xff"};
    for (int i = 0; i < 5; i++) {
        CHECK(TOLD(toron_property_index, law, unknown[i]) == TORON_UNKNOWN_NAME, "name %d", i);
        CHECK(TOLD(toron_state_index, law, unknown[i]) == TORON_UNKNOWN_NAME, "name %d", i);
    }
    REFUSED(TORON_NULL_ARGUMENT, "argument property is null", toron_property_index, law, NULL);
    REFUSED(TORON_NULL_ARGUMENT, "argument variable is null", toron_state_index, law, NULL);
    release();
}

static void tables(void)
{
    check_tables(TORON_HYPERELASTIC, TORON_HYPERELASTIC_PROPERTIES, TORON_HYPERELASTIC_STATE);
    check_tables(TORON_LINEAR_ELASTIC, TORON_LINEAR_ELASTIC_PROPERTIES, TORON_LINEAR_ELASTIC_STATE);
    check_tables(TORON_FRICTIONAL, TORON_FRICTIONAL_PROPERTIES, TORON_FRICTIONAL_STATE);
    toron_table_row row = {.size = sizeof row};
    REFUSED(TORON_UNKNOWN_NAME, "argument law is 3; allowed: 0 to 2", toron_property_count, 3);
    REFUSED(TORON_UNKNOWN_NAME, "argument law is -1; allowed: 0 to 2", toron_state_count, -1);
    REFUSED(TORON_UNKNOWN_NAME, "argument law is 3; allowed: 0 to 2", toron_property, 3, 0, &row);
    REFUSED(TORON_UNKNOWN_NAME, "argument law is 3; allowed: 0 to 2", toron_state_variable, 3, 0, &row);
    REFUSED(TORON_UNKNOWN_NAME, "argument law is 3; allowed: 0 to 2", toron_property_index, 3, "p");
    REFUSED(TORON_UNKNOWN_NAME, "argument law is 3; allowed: 0 to 2", toron_state_index, 3, "alive");
    REFUSED(TORON_UNKNOWN_NAME,
            "there is no property \"K_EL\"; allowed: k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, m_1, m_2, m_3",
            toron_property_index, TORON_HYPERELASTIC, "K_EL");
    REFUSED(TORON_UNKNOWN_NAME,
            "there is no state variable \"dead\"; allowed: "
            "w_el, w_tc, w_td, w_ld, i_el, i_tc, i_td, i_ld, failure_index, failed, alive",
            toron_state_index, TORON_HYPERELASTIC, "dead");
    toron_property(TORON_HYPERELASTIC, 2, &row, NULL, 0);
    CHECK(strcmp(row.name, "p") == 0 && row.minimum == 1 && row.minimum_excluded == 1 && row.maximum == 40 && row.has_default == 0,
          "p");
    CHECK(strcmp(row.allowed, "a number > 1, at most 40") == 0, "%s", row.allowed);
    toron_property(TORON_HYPERELASTIC, toron_property_index(TORON_HYPERELASTIC, "k_el", NULL, 0), &row, NULL, 0);
    CHECK(strcmp(row.unit, "stress") == 0 && row.mass == 1 && row.length == -1 && row.time == -2, "%s", row.unit);
    CHECK(toron_state_index(TORON_HYPERELASTIC, "w_el", NULL, 0) == ENERGIES, "w_el");
    CHECK(toron_state_index(TORON_HYPERELASTIC, "i_el", NULL, 0) == INVARIANTS, "i_el");
    CHECK(toron_state_index(TORON_HYPERELASTIC, "failed", NULL, 0) == FAILED, "failed");
    CHECK(toron_state_index(TORON_HYPERELASTIC, "alive", NULL, 0) == ALIVE, "alive");
    CHECK(toron_state_variable(TORON_HYPERELASTIC, ALIVE, &row, NULL, 0) == TORON_OK, "alive");
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
        int32_t status = TOLD(toron_preset_f64, "kevlar-km2-600", all[i].units, values, PROPERTIES, density);
        CHECK(status == TORON_OK, "%s: %d", all[i].units, status);
        CHECK(close_to(values[0], all[i].stress), "%s: k_el is %.17g", all[i].units, values[0]);
        CHECK(close_to(*density, all[i].density), "%s: the density is %.17g", all[i].units, *density);
        CHECK(close_to(values[2], 2.2) && close_to(values[5], 0.0458), "numbers have no unit");
        toron_hyperelastic_f64 *law = guarded(sizeof *law);
        CHECK(TOLD(toron_hyperelastic_prepare_f64, law, sizeof *law, values, PROPERTIES) == TORON_OK, "%s", all[i].units);
        status = TOLD(toron_preset_f32, "kevlar-km2-600", all[i].units, single, PROPERTIES, single_density);
        CHECK(status == TORON_OK && *single_density == (float)*density, "%s: %d", all[i].units, status);
        for (int k = 0; k < PROPERTIES; k++)
            CHECK(single[k] == (float)values[k], "%s: property %d", all[i].units, k);
        release();
    }
    enum { LINEAR = TORON_LINEAR_ELASTIC_PROPERTIES };
    real *values = reals(PROPERTIES);
#define PRESET ENTRY(toron_preset)
    REFUSED(TORON_UNKNOWN_NAME, "there is no preset \"nylon\"; allowed: kevlar-km2-600, kevlar-km2-600-linear, "
            "kevlar-km2-600-frictional", PRESET, "nylon",
            "si", values, PROPERTIES, NULL);
    CHECK(TOLD(PRESET, "kevlar-km2-600", "m-kg", values, PROPERTIES, NULL) == TORON_UNKNOWN_NAME, "units");
    CHECK(strstr(text, "there is no system of units \"m-kg\"; allowed: ") == text, "%s", text);
    REFUSED(TORON_NULL_ARGUMENT, "argument preset is null", PRESET, NULL, "si", values, PROPERTIES, NULL);
    REFUSED(TORON_NULL_ARGUMENT, "argument units is null", PRESET, "kevlar-km2-600", NULL, values, PROPERTIES, NULL);
    REFUSED(TORON_NULL_ARGUMENT, "argument properties is null", PRESET, "kevlar-km2-600", "si", NULL, PROPERTIES, NULL);
    REFUSED(TORON_PROPERTY_COUNT, "number of properties: 10 given, 11 needed", PRESET, "kevlar-km2-600", "si", values, LINEAR,
            NULL);
    REFUSED(TORON_PROPERTY_COUNT, "number of properties: 1000 given, 11 needed", PRESET, "kevlar-km2-600", "si", values, 1000,
            NULL);
    CHECK(untouched(values, PROPERTIES * sizeof *values), "nothing is written");
    CHECK(TOLD(PRESET, "kevlar-km2-600-linear", "mm-kg-ms", values, LINEAR, NULL) == TORON_OK, "linear");
    CHECK(values[0] == (real)79.414, "E1 is %.17g", (double)values[0]);
    toron_linear_elastic *law = guarded(sizeof *law);
    CHECK(TOLD(ENTRY(toron_linear_elastic_prepare), law, sizeof *law, values, LINEAR) == TORON_OK, "linear");
    release();
}

/* Properties that are refused, with these words, and a law that is not touched. */
static void refused(const real *values, size_t count, int32_t wanted, const char *words)
{
    toron_hyperelastic *law = guarded(sizeof *law);
    REFUSED(wanted, words, ENTRY(toron_hyperelastic_prepare), law, sizeof *law, values, count);
    CHECK(untouched(law, sizeof *law), "%s", words);
    release();
}

static void properties(void)
{
    real good[PROPERTIES], bad[PROPERTIES];
    toron_hyperelastic law;
    PRESET("kevlar-km2-600", "si", good, PROPERTIES, NULL, NULL, 0);
    CHECK(TOLD(ENTRY(toron_hyperelastic_prepare), &law, sizeof law, good, PROPERTIES) == TORON_OK, "%s", text);
    refused(NULL, PROPERTIES, TORON_NULL_ARGUMENT, "argument properties is null");
    refused(good, 10, TORON_PROPERTY_COUNT, "number of properties: 10 given, 11 needed");
    refused(good, 0, TORON_PROPERTY_COUNT, "number of properties: 0 given, 11 needed");
    refused(good, 1000, TORON_PROPERTY_COUNT, "number of properties: 1000 given, 11 needed");
    memcpy(bad, good, sizeof bad);
    bad[2] = 0.5;
    refused(bad, PROPERTIES, TORON_PROPERTY_OUT_OF_BOUNDS,
            "property 3 (p, transverse compaction exponent) is 0.5; allowed: a number > 1, at most 40");
    bad[0] = NAN;
    refused(bad, PROPERTIES, TORON_PROPERTY_NOT_FINITE,
            "property 1 (k_el, longitudinal elongation stiffness) is NaN; allowed: a number from 0 to 1e25");
    bad[0] = -INFINITY;
    refused(bad, PROPERTIES, TORON_PROPERTY_NOT_FINITE,
            "property 1 (k_el, longitudinal elongation stiffness) is -infinity; allowed: a number from 0 to 1e25");
    memcpy(bad, good, sizeof bad);
    bad[8] = bad[9] = bad[10] = 0;
    refused(bad, PROPERTIES, TORON_PROPERTY_DIRECTION,
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
