// toron for C++20: the laws as objects of plain data, structures with their size set, and errors as exceptions or, without them, as
// status codes and texts. It only calls toron.h, which documents all structures and functions.
//
//     toron::hyperelastic law{properties};               // throws toron::error, whose text names the wrong property
//     toron::block block{n};
//     block.deformation_gradient[0] = f.data();          // 9 components of n numbers, one after the other
//     block.stress[0] = stress.data();
//     int32_t worst = law(block);                        // 0, or a code below -300: points that cannot be evaluated
//
// There is nothing to release. A law may be copied, and used by several threads at a time.

#ifndef TORON_HPP
#define TORON_HPP

#if __cplusplus < 202002L
#error "toron.hpp needs C++20"
#endif

#include <span>
#include <string>

#if defined(__cpp_exceptions)
#include <stdexcept>
#endif

#include "toron.h"

namespace toron {

/// The text of an error, for calls that do not throw.
struct message {
    char text[TORON_MESSAGE_CAPACITY] = "";
    operator std::string() const { return text; }
};

/// Whether a status says that points could not be evaluated, while the call as such was right.
constexpr bool is_of_points(int32_t status) { return status < -300; }

#if defined(__cpp_exceptions)
/// A call that is wrong: its arguments or the properties.
struct error : std::runtime_error {
    int32_t status;
    error(int32_t code, const message &m) : std::runtime_error(m.text), status(code) {}
};

namespace detail {
template <class Call> int32_t checked(Call call)
{
    message m;
    const int32_t status = call(m);
    if (status < 0 && !is_of_points(status))
        throw error(status, m);
    return status;
}
} // namespace detail
#endif

namespace detail {

/// The structures and functions of a law in one precision.
struct hyperelastic_f64 {
    using real = double;
    using law = toron_hyperelastic_f64;
    using point = toron_point_f64;
    using block = toron_block_f64;
    static constexpr auto prepare = toron_hyperelastic_prepare_f64;
    static constexpr auto at_point = toron_hyperelastic_point_f64;
    static constexpr auto at_block = toron_hyperelastic_block_f64;
};
struct hyperelastic_f32 {
    using real = float;
    using law = toron_hyperelastic_f32;
    using point = toron_point_f32;
    using block = toron_block_f32;
    static constexpr auto prepare = toron_hyperelastic_prepare_f32;
    static constexpr auto at_point = toron_hyperelastic_point_f32;
    static constexpr auto at_block = toron_hyperelastic_block_f32;
};
struct frictional_f64 {
    using real = double;
    using law = toron_frictional_f64;
    using point = toron_point_f64;
    using block = toron_block_f64;
    static constexpr auto prepare = toron_frictional_prepare_f64;
    static constexpr auto at_point = toron_frictional_point_f64;
    static constexpr auto at_block = toron_frictional_block_f64;
};
struct frictional_f32 {
    using real = float;
    using law = toron_frictional_f32;
    using point = toron_point_f32;
    using block = toron_block_f32;
    static constexpr auto prepare = toron_frictional_prepare_f32;
    static constexpr auto at_point = toron_frictional_point_f32;
    static constexpr auto at_block = toron_frictional_block_f32;
};
struct linear_elastic_f64 {
    using real = double;
    using law = toron_linear_elastic_f64;
    using point = toron_linear_point_f64;
    using block = toron_linear_block_f64;
    static constexpr auto prepare = toron_linear_elastic_prepare_f64;
    static constexpr auto at_point = toron_linear_elastic_point_f64;
    static constexpr auto at_block = toron_linear_elastic_block_f64;
};
struct linear_elastic_f32 {
    using real = float;
    using law = toron_linear_elastic_f32;
    using point = toron_linear_point_f32;
    using block = toron_linear_block_f32;
    static constexpr auto prepare = toron_linear_elastic_prepare_f32;
    static constexpr auto at_point = toron_linear_elastic_point_f32;
    static constexpr auto at_block = toron_linear_elastic_block_f32;
};

/// A structure with its size set and everything else left out.
template <class Structure> struct with_size : Structure {
    with_size() : Structure{} { this->size = sizeof(Structure); }
};
template <class Structure> struct with_points : with_size<Structure> {
    explicit with_points(std::size_t points = 0) { this->n = points; }
};

/// A law that has been prepared from its properties.
template <class Law> class prepared {
    typename Law::law law_{};

public:
    using real = typename Law::real;
    using point = with_size<typename Law::point>;
    using block = with_points<typename Law::block>;

    /// Not prepared: a call with it is an error.
    prepared() = default;

    /// Returns 0, or a status code and its text.
    int32_t prepare(std::span<const real> properties, message &m) noexcept
    {
        return Law::prepare(&law_, sizeof law_, properties.data(), properties.size(), m.text, sizeof m.text);
    }
    int32_t operator()(const typename Law::point &p, message &m) const noexcept
    {
        return Law::at_point(&law_, &p, m.text, sizeof m.text);
    }
    int32_t operator()(const typename Law::block &b, message &m) const noexcept
    {
        return Law::at_block(&law_, &b, m.text, sizeof m.text);
    }
#if defined(__cpp_exceptions)
    /// These throw `error` if the call is wrong, and return 0 or the worst code of the points.
    explicit prepared(std::span<const real> properties)
    {
        checked([&](message &m) { return prepare(properties, m); });
    }
    int32_t operator()(const typename Law::point &p) const
    {
        return checked([&](message &m) { return (*this)(p, m); });
    }
    int32_t operator()(const typename Law::block &b) const
    {
        return checked([&](message &m) { return (*this)(b, m); });
    }
#endif
    /// What the functions of toron.h take.
    const typename Law::law *get() const noexcept { return &law_; }
};

} // namespace detail

using hyperelastic = detail::prepared<detail::hyperelastic_f64>;
using hyperelastic_f32 = detail::prepared<detail::hyperelastic_f32>;
using frictional = detail::prepared<detail::frictional_f64>;
using frictional_f32 = detail::prepared<detail::frictional_f32>;
using linear_elastic = detail::prepared<detail::linear_elastic_f64>;
using linear_elastic_f32 = detail::prepared<detail::linear_elastic_f32>;

using point = hyperelastic::point;
using block = hyperelastic::block;
using point_f32 = hyperelastic_f32::point;
using block_f32 = hyperelastic_f32::block;
using linear_point = linear_elastic::point;
using linear_block = linear_elastic::block;
using linear_point_f32 = linear_elastic_f32::point;
using linear_block_f32 = linear_elastic_f32::block;

} // namespace toron

#endif // TORON_HPP
