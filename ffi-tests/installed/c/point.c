/* A C project: one point of a preset yarn, drawn by 2 %. */
#include <stdio.h>
#include <toron.h>

int main(void)
{
    double properties[TORON_HYPERELASTIC_PROPERTIES], stress[6];
    const double f[9] = {1.02, 0, 0, 0, 1, 0, 0, 0, 1};
    toron_hyperelastic_f64 law;
    char message[TORON_MESSAGE_CAPACITY];
    int32_t status = toron_preset_f64("kevlar-km2-600", "mm-tonne-s", properties, TORON_HYPERELASTIC_PROPERTIES, NULL,
                                      message, sizeof message);
    if (status == TORON_OK)
        status = toron_hyperelastic_prepare_f64(&law, sizeof law, properties, TORON_HYPERELASTIC_PROPERTIES, message,
                                                sizeof message);
    if (status == TORON_OK) {
        toron_point_f64 point = {.size = sizeof point, .deformation_gradient = f, .stress = stress};
        status = toron_hyperelastic_point_f64(&law, &point, message, sizeof message);
    }
    if (status != TORON_OK) {
        fprintf(stderr, "%s\n", message);
        return 1;
    }
    printf("%.3f MPa\n", stress[0]);
    return 0;
}
