/* The library that the solver loads by itself, in a program that has the starter's routines and not the engine's. */
#include "solver.h"

/* What the starter's reader is reading. */
void cpp_current_option_(int *id, int *unit, int *include, char *key, int *key_length, char *title, int *title_length)
{
    *id = 12, *unit = *include = 0;
    *key_length = sprintf(key, "/MAT/USER01");
    *title_length = sprintf(title, "warp yarns");
}

/* The thesis's yarn in N, mm, s; the last value is an option. */
static const double yarn[12] = {82341, 1055, 2.2, 649.74, 0, 0.0458, 1.8, 0, 1, 0, 0, 0};
static const double linear[13] = {79414, 794, 126, 3637, 1, 0, 0, 0, 0, 0, 0, 0, 0};

static void cards(void)
{
    material m = read_card(1, card_of(yarn, 12));
    CHECK(stops == 0, "%s", said);
    CHECK(m.nuparam == 14 && m.nuvar == 18 && m.nfunc == 0, "%d, %d, %d", m.nuparam, m.nuvar, m.nfunc);
    CHECK(m.uparam[0] == 1 && isnan(m.uparam[14]), "%g, %g", (double)m.uparam[0], (double)m.uparam[14]);
    for (int i = 0; i < 12; i++)
        CHECK(m.uparam[1 + i] == (real)yarn[i], "value %d", i + 1);
    CHECK(fabs((double)m.parmat[0] / 82341 - 1) < 1e-6, "%g", (double)m.parmat[0]);
    static const char *const lines[] = {"hyperelastic yarn law\n", "/PROP/TYPE14", "Isolid = 1, Ismstr = 10, Iframe = 1",
                                        "k_el (longitudinal elongation stiffness) = 82341.0\n", "fibre_from = 0.0\n", "limit_from = 0.0\n", "10 failed\n",
                                        "12 fibre_1\n", "15 deleted\n", "18 diagonal_3\n"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        CHECK(strstr(m.listing, lines[i]) != NULL, "\"%s\" in the listing: %s", lines[i], m.listing);

    m = read_card(2, card_of(linear, 10)); /* the options left out */
    CHECK(stops == 0, "%s", said);
    CHECK(m.nuparam == 15 && m.nuvar == 26 && m.uparam[0] == 2, "%d, %d", m.nuparam, m.nuvar);
    CHECK(fabs((double)m.parmat[0] / 79414 - 1) < 1e-6, "%g", (double)m.parmat[0]);
    CHECK(strstr(m.listing, "23 F33_old\n") != NULL, "%s", m.listing);
    m = read_card(2, "# a comment\n 79414. 794               \n"); /* read with blanks between the numbers */
    STOPPED_WITH("USER02", "line 1", "\"79414. 794\" in columns 1 to 20", "one number");
    /* Fortran's exponents, no blank between full fields, blank fields and a blank line, which are 0. */
    m = read_card(1, " 8.2341000000000D+041.055000000000000e03                 2.2              649.74\n"
                     "              0.0458                 1.8                                       1\n"
                     "\n");
    CHECK(stops == 0, "%s", said);
    for (int i = 0; i < 12; i++)
        CHECK(m.uparam[1 + i] == (real)yarn[i], "value %d", i + 1);
}

static void refusals(void)
{
    double wrong[13];
    memcpy(wrong, yarn, sizeof yarn);
    wrong[2] = 0.5;
    read_card(1, card_of(wrong, 12));
    STOPPED_WITH("/MAT/USER01/12 (warp yarns): ", "property 3 (p, transverse compaction exponent) is 0.5", "> 1, at most 40");
    memcpy(wrong, yarn, sizeof yarn);
    wrong[11] = 3;
    read_card(1, card_of(wrong, 12));
    STOPPED_WITH("fibre_from", "3.0", "0 (the fibre direction of the card), 1", "2 (");
    double long_card[14];
    memcpy(long_card, yarn, sizeof yarn);
    long_card[12] = 4, long_card[13] = 0;
    read_card(1, card_of(long_card, 13));
    STOPPED_WITH("limit_from", "4.0", "1 (of each element");
    long_card[12] = 0, long_card[13] = 4;
    read_card(1, card_of(long_card, 14));
    STOPPED_WITH("behind the last value", "4.0");
    read_card(1, card_of(yarn, 10));
    STOPPED_WITH("number of values", "10 given, 11 needed");
    memcpy(wrong, yarn, sizeof yarn);
    wrong[8] = 0;
    read_card(1, card_of(wrong, 12));
    STOPPED_WITH("properties 9 to 11 (fibre direction) are 0.0, 0.0, 0.0");
    wrong[11] = 1; /* each element has its own */
    material m = read_card(1, card_of(wrong, 12));
    CHECK(stops == 0 && m.uparam[9] == 1 && m.uparam[12] == 1, "%s", said);
    memcpy(wrong, linear, sizeof linear);
    wrong[4] = 0, wrong[7] = 1, wrong[10] = 1; /* and the second axis is the first one */
    m = read_card(2, card_of(wrong, 13));
    CHECK(stops == 0 && m.uparam[5] == 0 && m.uparam[6] == 1, "%s", said);
    read_card(4, card_of(yarn, 12));
    STOPPED_WITH("nn of /MAT/USERnn is 4", "1 (USER01", "2 (USER02", "3 (USER03");
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    load(argv[1]);
    cards();
    refusals();
    routine("st_siniusr_")();
    STOPPED_WITH("a user solid element", "/MAT/USER01 and /MAT/USER02");
    return finish();
}
