/* The law of examples/own_law as OpenRadioss loads it, `/MAT/USER03`, against its own functions in C. */
#include "../openradioss/solver.h"

#include "reinforced.h"

static const double card[8] = {31, 17, 230, 1.3, 1, 0, 0, 0};
enum { FIBRE = 5, DELETED = 8, NEL = 100 };

static void starter(void)
{
    material m = read_card(3, card_of(card, 8));
    CHECK(stops == 0, "%s", said);
    CHECK(m.nuparam == 9 && m.nuvar == DELETED + 3 && m.uparam[0] == 3, "%d, %d", m.nuparam, m.nuvar);
    const double modulus = 17 + 2 * 31 + 4 * 230; /* of the wave along the fibre, which the bound may exceed */
    CHECK(m.parmat[0] >= (real)0.999999 * (real)modulus && m.parmat[0] < 3 * modulus, "%g", (double)m.parmat[0]);
    static const char *const lines[] = {"standard reinforcing model\n", "stretch_lim (fibre stretch at failure", "fibre_from = 0.0\n",
                                        "2 stretch\n", "5 fibre_1\n", "8 deleted\n"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        CHECK(strstr(m.listing, lines[i]) != NULL, "\"%s\" in the listing: %s", lines[i], m.listing);
    double wrong[9];
    memcpy(wrong, card, sizeof card);
    wrong[0] = 0;
    read_card(3, card_of(wrong, 8));
    STOPPED_WITH("/MAT/USER03", "property 1 (mu, shear modulus of the solid) is 0.0");
    read_card(1, card_of(card, 8));
    STOPPED_WITH("nn of /MAT/USERnn is 1; allowed: 3 (REINFORCED)");
    routine("st_siniusr_")();
    STOPPED_WITH("a user solid element", "materials of solids alone: /MAT/USER03");
}

/* The fibre from the card or from initial values; pulled until elements fail. */
static void engine(int fibre_from)
{
    double values[8];
    memcpy(values, card, sizeof card);
    values[7] = fibre_from;
    const material m = read_card(3, card_of(values, 8));
    group g = new_group(&m, 3, NEL, MVSIZ);
    ENTRY(REINFORCED) law;
    char message[REINFORCED_MESSAGE_CAPACITY];
    CHECK(ENTRY(REINFORCED_prepare)(&law, sizeof law, m.uparam + 1, REINFORCED_PROPERTIES, message, sizeof message) == 0, "%s", message);
    real state[NEL][REINFORCED_STATE] = {{0}};
    int failed = 0;
    for (int step = 0; step < 20; step++) {
        for (int i = 0; i < NEL; i++) {
            const double t = step / 20.0, pull = 1 + 0.8 * t * i / NEL, side = 1 - 0.1 * t, shear = 0.1 * t * (i % 3);
            const double f[9] = {pull, shear, 0, 0.05 * t, side, 0, 0, 0.02 * t * (i % 5), 1};
            static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
            set_f(&g, i, step > 0 && g.off[i] == 1 ? f : identity);
            if (step == 0 && fibre_from == 2)
                for (int c = 0; c < 3; c++)
                    *variable(&g, FIBRE + c, i) = (real)(1 + c * (i % 4));
        }
        cycle(&g);
        CHECK(stops == 0, "%s", said);
        for (int i = 0; i < NEL; i++) {
            real f[9], fibre[3], stress[6], speed, active;
            get_f(&g, i, f);
            for (int c = 0; c < 3; c++)
                fibre[c] = (real)(1 + c * (i % 4));
            ENTRY(REINFORCED_points) p = {.size = sizeof p, .n = 1, .density = 1351.4, .f_new = {f}, .state_old = state[i],
                                          .state_new = state[i], .stress = {stress}, .wave_speed = &speed, .active = &active};
            p.fibre[0] = fibre_from == 2 ? fibre : NULL;
            CHECK(ENTRY(REINFORCED_block)(&law, &p, message, sizeof message) == 0, "%s", message);
            for (int c = 0; c < 6; c++)
                CHECK(fabs((double)(g.sign[c][i] - stress[c])) <= ALLOWED * 2000, "stress %d of element %d: %g, %g", c, i,
                      (double)g.sign[c][i], (double)stress[c]);
            CHECK(fabs((double)(*variable(&g, 1, i) - state[i][0])) <= ALLOWED * 200, "energy of element %d", i);
            CHECK(fabs((double)(g.ssp[i] / speed - 1)) <= 10 * ALLOWED, "wave speed of element %d: %g, %g", i, (double)g.ssp[i], (double)speed);
            CHECK(g.off[i] == active && *variable(&g, DELETED, i) == state[i][REINFORCED_STATE_FAILED], "failure of element %d", i);
        }
    }
    for (int i = 0; i < NEL; i++)
        failed += g.off[i] == 0;
    CHECK(failed > 0 && failed < NEL, "%d elements fail", failed);
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    load(argv[1]);
    starter();
    engine(0);
    engine(2);
    return finish();
}
