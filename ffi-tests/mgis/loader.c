/* Loads all behaviours in all hypotheses as MGIS or MTest does.
 *
 *     loader LIBRARY mgis|mtest [SYMBOL]
 *
 * Prints the symbols that had to be there, each in a line; with a symbol, that one is not found, and loading it must fail. Checks the
 * names, and the bounds, against the tables of libtoron. */
#include "mgis.h"

static void check_names(const behaviour *b, int32_t law)
{
    toron_table_row row = {.size = sizeof row};
    CHECK(b->properties.count == toron_property_count(law, NULL, 0), "%s: %d", b->name, b->properties.count);
    for (int i = 0; i < b->properties.count; i++) {
        toron_property(law, i, &row, NULL, 0);
        CHECK(strcmp(b->properties.names[i], row.name) == 0, "%s: property %d is %s", b->name, i, b->properties.names[i]);
    }
    CHECK(b->state.count == toron_state_count(law, NULL, 0), "%s: %d", b->name, b->state.count);
    for (int i = 0; i < b->state.count; i++) {
        toron_state_variable(law, i, &row, NULL, 0);
        CHECK(strcmp(b->state.names[i], row.name) == 0, "%s: variable %d is %s", b->name, i, b->state.names[i]);
    }
    CHECK(b->external.count == 0 && b->parameters.count == 0, "%s", b->name);
    CHECK(b->stores_energy == 1 && b->dissipates_energy == (law == TORON_FRICTIONAL), "%s", b->name);
}

/* One bound, under one of its names: C's own long double of the table's value, or no symbol where that is infinite. */
static void check_bound(const behaviour *b, const char *property, const char *side, double wanted)
{
    char name[80];
    snprintf(name, sizeof name, "%s_%s", property, side);
    const void *found = optional(b, name);
    CHECK((found != NULL) == (isfinite(wanted) != 0), "%s: %s", b->name, name);
    if (found == NULL)
        return;
    CHECK((uintptr_t)found % _Alignof(long double) == 0, "%s: %s is not aligned", b->name, name);
    const long double value = (long double)wanted;
    unsigned char padded[sizeof value] = {0};
    memcpy(padded, &value, 10); /* an x87 number has ten bytes */
    CHECK(*(const long double *)found == value, "%s: %s is %Lg", b->name, name, *(const long double *)found);
    CHECK(memcmp(found, padded, sizeof padded) == 0, "%s: the bytes of %s", b->name, name);
}

static void check_bounds(const behaviour *b, int32_t law)
{
    toron_table_row row = {.size = sizeof row};
    for (int i = 0; i < b->properties.count; i++) {
        toron_property(law, i, &row, NULL, 0);
        check_bound(b, row.name, "LowerBound", row.minimum);
        check_bound(b, row.name, "LowerPhysicalBound", row.minimum);
        check_bound(b, row.name, "UpperBound", row.maximum);
        check_bound(b, row.name, "UpperPhysicalBound", row.maximum);
    }
}

int main(int argc, char **argv)
{
    if (argc < 3) {
        fputs("usage: loader LIBRARY mgis|mtest [SYMBOL]\n", stderr);
        return 2;
    }
    open_library(argv[1]);
    hidden = argc > 3 ? argv[3] : NULL;
    listing = hidden == NULL;
    int mtest = strcmp(argv[2], "mtest") == 0;
    for (int law = 0; law < BEHAVIOURS; law++)
        for (int h = 0; h < HYPOTHESES; h++) {
            behaviour b = mtest ? load_as_mtest(behaviours[law], hypotheses[h]) : load(behaviours[law], hypotheses[h]);
            check_names(&b, law);
            check_bounds(&b, law);
        }
    return finish();
}
