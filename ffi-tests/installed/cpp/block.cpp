// A C++ project: a block of points in either precision, with exceptions and without.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <toron.hpp>
#include <type_traits>
#include <vector>

static int failures = 0;
static void check(bool good, const char *what)
{
    if (!good) {
        std::printf("%s\n", what);
        failures++;
    }
}

template <class Law> void points_of(const std::vector<typename Law::real> &properties)
{
    using real = typename Law::real;
    const std::size_t n = 37;
    std::vector<real> f(9 * n), stress(6 * n), one(6);
    std::vector<int32_t> status(n);
    for (std::size_t i = 0; i < n; i++)
        for (std::size_t c = 0; c < 9; c += 4)
            f[c * n + i] = real(1 + 0.001 * double(i));
    f[5] = -1; // point 5 is inverted
    Law law;
    toron::message m;
    check(law.prepare(properties, m) == TORON_OK, m.text);
    const Law copy = law;
    typename Law::block block{n};
    block.deformation_gradient[0] = f.data();
    block.stress[0] = stress.data();
    block.status = status.data();
    check(copy(block, m) == TORON_INVERTED && status[5] == TORON_INVERTED, "the inverted point");
    check(std::strncmp(m.text, "point 5, counted from 0:", 24) == 0, m.text);
    std::vector<real> columns(9);
    for (std::size_t c = 0; c < 9; c++)
        columns[c] = f[c * n + 20];
    typename Law::point point;
    point.deformation_gradient = columns.data();
    point.stress = one.data();
    check(law(point, m) == TORON_OK, m.text);
    check(std::abs(one[0] - stress[20]) <= real(1e-5) * std::abs(one[0]), "a point alone");

    std::vector<real> wrong = properties;
    wrong[2] = 0.5;
    check(law.prepare(wrong, m) == TORON_PROPERTY_OUT_OF_BOUNDS && std::strstr(m.text, "allowed: "), m.text);
#if defined(__cpp_exceptions)
    try {
        Law{wrong};
        check(false, "no exception");
    } catch (const toron::error &error) {
        check(error.status == TORON_PROPERTY_OUT_OF_BOUNDS && std::strstr(error.what(), "property 3"), error.what());
    }
    check(Law{properties}(block) == TORON_INVERTED, "points at fault are no exception");
    block.level = 9;
    try {
        Law{properties}(block);
        check(false, "no exception");
    } catch (const toron::error &error) {
        check(error.status == TORON_BAD_ARGUMENT, error.what());
    }
#endif
}

int main()
{
    static_assert(std::is_trivially_copyable_v<toron::hyperelastic>);
    static_assert(sizeof(toron::block) == sizeof(toron_block_f64));
    points_of<toron::hyperelastic>({82341, 1055, 2.2, 649.74, 100, 0.0458, 1.8, 0, 1, 0, 0});
    points_of<toron::hyperelastic_f32>({82341, 1055, 2.2f, 649.74f, 100, 0.0458f, 1.8f, 0, 1, 0, 0});
    toron::linear_elastic linear;
    toron::message m;
    const double properties[] = {79414, 794, 126, 3637, 1, 0, 0, 0, 0, 0};
    const double rest[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, drawn[9] = {1.02, 0, 0, 0, 1, 0, 0, 0, 1};
    double stress[6];
    toron::linear_point point;
    point.f_old = rest;
    point.f_new = drawn;
    point.stress = stress;
    check(linear(point, m) == TORON_NOT_PREPARED, m.text);
    check(linear.prepare(properties, m) == TORON_OK && linear(point, m) == TORON_OK, m.text);
    check(std::abs(stress[0] - 79414 * std::log(1.02)) < 1e-9, "the linear law");
    return failures != 0;
}
