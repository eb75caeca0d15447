/* The law of examples/own_law as LS-DYNA's shims call it: the library of double precision, or with -DSINGLE that of single precision. */
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#ifdef SINGLE
typedef float real;
#define IN_PRECISION(name) name##_f32
#define ROUNDING 1e-6
#define STEP 1e-2
#else
typedef double real;
#define IN_PRECISION(name) name##_f64
#define ROUNDING 1e-14
#define STEP 1e-5
#endif

#define UMAT IN_PRECISION(REINFORCED_lsdyna_umat_at)
#define UMAT_VECTOR IN_PRECISION(REINFORCED_lsdyna_umat_vector_at)
#define UTAN IN_PRECISION(REINFORCED_lsdyna_utan_at)
#define UTAN_VECTOR IN_PRECISION(REINFORCED_lsdyna_utan_vector_at)
#define BULK_AND_SHEAR IN_PRECISION(REINFORCED_lsdyna_bulk_and_shear)

/* dt1, tt and temper, of a block dt1siz, tt and temps. This law reads none of them. */
#define WHEN const real *step, const real *time, const real *temperature
#define UNKNOWN NULL, NULL, NULL

int32_t UMAT(const real *cm, real *sig, real *hsv, int32_t nhv, int *failel, WHEN, char *message, size_t capacity);
int32_t UMAT_VECTOR(const real *cm, real *sig1, real *sig2, real *sig3, real *sig4, real *sig5, real *sig6, real *hsvs, int32_t nhv,
                    int32_t lft, int32_t llt, int32_t nlq, int *failels, WHEN, char *message, size_t capacity);
int32_t UTAN(const real *cm, const real *hsv, int32_t nhv, real *es, WHEN, char *message, size_t capacity);
int32_t UTAN_VECTOR(const real *cm, const real *hsvs, int32_t nhv, int32_t lft, int32_t llt, int32_t nlq, real *dsave, WHEN, char *message,
                    size_t capacity);
int32_t BULK_AND_SHEAR(const real *values, size_t count, real *bulk, real *shear, char *message, size_t capacity);

static int failures;
#define CHECK(condition, ...) \
    ((condition) ? (void)0 : (void)(failures++, fprintf(stderr, "%s:%d: %s: ", __FILE__, __LINE__, #condition), \
                                    fprintf(stderr, __VA_ARGS__), fputc('\n', stderr)))

enum { STATE = 4, HISTORY = STATE + 9, ELEMENTS = 70, NLQ = 77, FIRST = 4 };
static const real card[9] = {1000, 3000, 20000, 1.25, 0.8f, 0.6f, 0};
static char message[512];
#define MESSAGE message, sizeof message

/* An element at rest whose F, by columns, is that of a bent and sheared solid; no two are the same. */
static void deform(real *hsv, int element)
{
    for (int j = 0; j < HISTORY; j++)
        hsv[j] = j < STATE ? 0 : (real)(0.1 * sin(j + 7 * element)) + (j % 4 == 0);
}

static void evaluate(real *hsv, real *sig)
{
    int failed = -1;
    CHECK(UMAT(card, sig, hsv, STATE, &failed, UNKNOWN, MESSAGE) == 0 && failed == 0, "%s", message);
}

/* Elements of a vector one by one, to the last digit; those around them are not touched. */
static void vector_is_scalar(void)
{
    static real sig[6][NLQ], hsvs[HISTORY * NLQ], dsave[36 * NLQ];
    int failed[NLQ];
    for (int j = 0; j < HISTORY * NLQ; j++)
        hsvs[j] = -7;
    for (int j = 0; j < 36 * NLQ; j++)
        dsave[j] = -7;
    for (int i = 0; i < NLQ; i++)
        failed[i] = -7;
    for (int i = 0; i < ELEMENTS; i++) {
        real hsv[HISTORY];
        deform(hsv, i);
        for (int j = 0; j < HISTORY; j++)
            hsvs[FIRST + i + j * NLQ] = hsv[j];
    }
    int32_t code = UMAT_VECTOR(card, sig[0], sig[1], sig[2], sig[3], sig[4], sig[5], hsvs, STATE, FIRST + 1, FIRST + ELEMENTS, NLQ,
                               failed, UNKNOWN, MESSAGE);
    CHECK(code == 0, "%s", message);
    code = UTAN_VECTOR(card, hsvs, STATE, FIRST + 1, FIRST + ELEMENTS, NLQ, dsave, UNKNOWN, MESSAGE);
    CHECK(code == 0, "%s", message);
    for (int i = 0; i < ELEMENTS; i++) {
        real hsv[HISTORY], stress[6], es[36];
        deform(hsv, i);
        evaluate(hsv, stress);
        CHECK(UTAN(card, hsv, STATE, es, UNKNOWN, MESSAGE) == 0, "%s", message);
        for (int c = 0; c < 6; c++)
            CHECK(stress[c] == sig[c][FIRST + i], "element %d: %.17g, %.17g", i, (double)stress[c], (double)sig[c][FIRST + i]);
        for (int j = 0; j < HISTORY; j++)
            CHECK(hsv[j] == hsvs[FIRST + i + j * NLQ], "element %d, %d", i, j);
        for (int j = 0; j < 36; j++)
            CHECK(es[j] == dsave[FIRST + i + j * NLQ], "element %d, %d", i, j);
        CHECK(failed[FIRST + i] == 0, "element %d", i);
    }
    CHECK(failed[FIRST - 1] == -7 && failed[FIRST + ELEMENTS] == -7, "elements beside those that are named");
    CHECK(hsvs[FIRST - 1] == -7 && dsave[FIRST + ELEMENTS] == -7, "elements beside those that are named");
}

/* c : D of the Truesdell rate for a strain D: of the stress at (1 + h D) F, minus D s + s D - tr(D) s. */
static void tangent_is_that_of_differences(void)
{
    static const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0}, voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    for (int element = 0; element < 9; element++) {
        real hsv[HISTORY], sig[6], es[36], moved[2][6], worst = 0, largest = 0;
        deform(hsv, element);
        evaluate(hsv, sig);
        CHECK(UTAN(card, hsv, STATE, es, UNKNOWN, MESSAGE) == 0, "%s", message);
        for (int q = 0; q < 6; q++) {
            real d[3][3] = {{0}};
            d[row[q]][column[q]] += (real)0.5;
            d[column[q]][row[q]] += (real)0.5;
            for (int side = 0; side < 2; side++) {
                real other[HISTORY], h = (real)(side ? -STEP : STEP);
                memcpy(other, hsv, sizeof other);
                for (int j = 0; j < 3; j++)
                    for (int i = 0; i < 3; i++)
                        for (int k = 0; k < 3; k++)
                            other[STATE + 3 * j + i] += h * d[i][k] * hsv[STATE + 3 * j + k];
                evaluate(other, moved[side]);
            }
            for (int p = 0; p < 6; p++) {
                double wanted = ((double)moved[0][p] - (double)moved[1][p]) / (2 * STEP);
                for (int k = 0; k < 3; k++) {
                    wanted -= (double)(d[row[p]][k] * sig[voigt[k][column[p]]] + sig[voigt[row[p]][k]] * d[k][column[p]]);
                    wanted += (double)(d[k][k] * sig[p]);
                }
                worst = (real)fmax((double)worst, fabs((double)es[6 * q + p] - wanted));
                largest = (real)fmax((double)largest, fabs(wanted));
            }
        }
        CHECK((double)worst < (sizeof(real) == 4 ? 3e-3 : 1e-8) * (double)largest, "%g of %g", (double)worst, (double)largest);
    }
}

/* An element that is torn, and one that is inverted. */
static void failed_elements(void)
{
    real hsv[HISTORY] = {0, 0, 0, 0, (real)1.3, 0, 0, 0, (real)1.3, 0, 0, 0, 1}, sig[6], es[36];
    int failed = -1;
    CHECK(UMAT(card, sig, hsv, STATE, &failed, UNKNOWN, MESSAGE) == 0 && failed == 1 && hsv[2] == 1 && hsv[3] == 0, "%d", failed);
    CHECK(UMAT(card, sig, hsv, STATE, &failed, UNKNOWN, MESSAGE) == 0 && failed == 1 && sig[0] == 0, "%g", (double)sig[0]);
    CHECK(UTAN(card, hsv, STATE, es, UNKNOWN, MESSAGE) == 0 && es[0] == 0, "%g", (double)es[0]);
    deform(hsv, 0);
    evaluate(hsv, sig);
    for (int j = 4; j < 7; j++)
        hsv[j] = -hsv[j];
    int32_t code = UMAT(card, sig, hsv, STATE, &failed, UNKNOWN, MESSAGE);
    CHECK(code < -300 && failed == 1 && sig[0] == 0 && hsv[3] == 0, "%d, %d", (int)code, failed);
}

/* K + 4G/3 is the stiffness at rest of the fastest wave, that along the fibre, or more by what the bound of a law without one of its
   own may be too large. */
static void moduli(void)
{
    real bulk = 0, shear = 0;
    CHECK(BULK_AND_SHEAR(card, 7, &bulk, &shear, MESSAGE) == 0, "%s", message);
    double modulus = (double)bulk + 4 * (double)shear / 3, fastest = 2 * 1000 + 3000 + 4 * 20000;
    CHECK(modulus > fastest * (1 - ROUNDING) && modulus < 3 * fastest, "%g", modulus);
}

static void refused(int32_t code, const char *text)
{
    CHECK(code > -300 && code < 0 && strstr(message, text) != NULL, "%d, %s", (int)code, message);
}

static void wrong_cards(void)
{
    real hsv[HISTORY], sig[6], bulk, wrong[9];
    int failed = 0;
    deform(hsv, 0);
    refused(UMAT(card, sig, hsv, 5, &failed, UNKNOWN, MESSAGE), "number of history variables, NHV, of the standard reinforcing model: 5 given, 4 needed");
    memcpy(wrong, card, sizeof wrong);
    wrong[2] = -1;
    refused(UMAT(wrong, sig, hsv, STATE, &failed, UNKNOWN, MESSAGE), "property 3 (k, stiffness of the fibres) is -1");
    refused(BULK_AND_SHEAR(card, 8, &bulk, &bulk, MESSAGE), "8 given, 7 needed");
    memset(hsv, 0, sizeof hsv);
    const char *needed = "set IHYPER = 1 or -1, and NHV = 4 (standard reinforcing model)";
    refused(UMAT(card, sig, hsv, STATE, &failed, UNKNOWN, MESSAGE), needed);
    /* F as it starts, where the card has another NHV. */
    for (int nhv = 0; nhv < 4; nhv++) {
        memset(hsv, 0, sizeof hsv);
        for (int k = 0; k < 3; k++)
            hsv[nhv + 4 * k] = 1;
        refused(UMAT(card, sig, hsv, STATE, &failed, UNKNOWN, MESSAGE), needed);
    }
}

int main(void)
{
    vector_is_scalar();
    tangent_is_that_of_differences();
    failed_elements();
    moduli();
    wrong_cards();
    return failures > 0;
}
