// Vectors of the compiler's own, which code for every processor may use.
#pragma once

#include <cstddef>

namespace raytrace {

namespace detail {
template <class T, std::size_t lanes>
struct CompilerVectorOf {
  typedef T type __attribute__((vector_size(lanes * sizeof(T))));
};
}  // namespace detail

/// Vector types of the compiler: it converts them where there is no instruction that xsimd knows of.
template <class T, std::size_t lanes>
using CompilerVector = typename detail::CompilerVectorOf<T, lanes>::type;

}  // namespace raytrace
