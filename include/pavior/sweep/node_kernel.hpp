#pragma once
/// \file
/// The inner loops of a sweep: positions of the nodes of one level, and the weighted residuals of the boundary
/// correction. One source for all instruction sets, chosen at run time; all give the same bits.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

// PAVIOR_SCALAR_KERNELS: no vectors, to compare with.
#if defined(__x86_64__) && defined(__GNUC__) && defined(__has_builtin) && !defined(PAVIOR_SCALAR_KERNELS)
#if __has_builtin(__builtin_shufflevector)
#define PAVIOR_HAS_VECTOR_KERNELS
#endif
#endif

// Keeps the compiler from fusing a product with the sum that follows.
#if defined(__x86_64__) && defined(__GNUC__)
#define PAVIOR_ROUNDED(product) __asm__("" : "+v"(product))
#elif defined(__aarch64__) && defined(__GNUC__)
#define PAVIOR_ROUNDED(product) __asm__("" : "+w"(product))
#else
#define PAVIOR_ROUNDED(product) static_cast<void>(product)
#endif

// fma(a, b, c): a * b + c rounded once, on every machine.
#if defined(__GNUC__)
#define PAVIOR_FUSED(a, b, c) __builtin_fma(a, b, c)
#define PAVIOR_KERNEL_INLINE [[gnu::always_inline]] inline
#else
#define PAVIOR_FUSED(a, b, c) std::fma(a, b, c)
#define PAVIOR_KERNEL_INLINE inline
#endif

namespace pavior {

/// Instruction sets that the kernels are compiled for, in rising order; only `scalar` exists outside x86-64.
enum class InstructionSet : std::uint8_t { scalar, sse2, avx2, avx512 };

/// The map of one level: z = centre + sum_s linear[s] * w_s, where (w_0 .. w_5) is the node on the source cap, then on
/// the target cap, both as in CapCoordinates.
struct LevelOperator {
    std::array<std::array<double, 3>, 6> linear{};  ///< linear[s][c]: column s of the 3 x 6 matrix
    std::array<double, 3> centre{};
};

/// Six arrays of one value a node: x, y, z on the source cap, then on the target cap.
struct CapCoordinates {
    std::array<const double*, 6> row{};
};

namespace detail {

/// Nodes that one tile of weights holds, and residual columns of one strip.
inline constexpr std::size_t weight_tile = 16;
inline constexpr std::size_t strip_columns = 12;
/// Added to squared distances (of a cap of size 1), so that a node at distance zero takes all.
inline constexpr double least_square_distance = 1e-100;

/// Positions of nodes [begin, end): out[3 * (i - begin) + c] is coordinate c of node i. \p correction is null or holds
/// what is added to it at [c * stride + (i - begin)].
PAVIOR_KERNEL_INLINE void apply_level_by_node(const LevelOperator& level, const CapCoordinates& caps,
                                              const double* correction, std::size_t stride, std::size_t begin,
                                              std::size_t end, double* out) {
    for (std::size_t i = begin; i < end; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            double sum = 0.0 + level.centre[c];
            for (std::size_t s = 0; s < 6; ++s) {
                sum = PAVIOR_FUSED(caps.row[s][i], level.linear[s][c], sum);
            }
            out[3 * (i - begin) + c] = correction == nullptr ? sum : sum + correction[c * stride + (i - begin)];
        }
    }
}

/// Nodes to do one by one until \p out, advanced by three doubles a node, is aligned to 64 bytes; at most 7.
inline std::size_t nodes_to_alignment(const double* out) {
    std::size_t nodes = 0;
    while (nodes < 8 && (reinterpret_cast<std::uintptr_t>(out) + 24 * nodes) % 64 != 0) {
        ++nodes;
    }
    return nodes;
}

/// apply_level_by_node() without special instructions.
inline void apply_level_scalar(const LevelOperator& level, const CapCoordinates& caps, const double* correction,
                               std::size_t stride, std::size_t begin, std::size_t end, double* out) {
    apply_level_by_node(level, caps, correction, stride, begin, end, out);
}

/// Weights of the \p loop_size loop points at weight_tile nodes: weights[i * weight_tile + j] = 1 / |p_j - x_i|^2 and
/// sums[j], their sum over i. node[c] and loop[c] are arrays of coordinate c, of weight_tile and loop_size values.
inline void inverse_square_weights_scalar(const double* const* node, const double* const* loop, std::size_t loop_size,
                                          double* weights, double* sums) {
    for (std::size_t j = 0; j < weight_tile; ++j) {
        double sum = 0.0;
        for (std::size_t i = 0; i < loop_size; ++i) {
            double distance = 0.0 + least_square_distance;
            for (int c = 0; c < 3; ++c) {
                const double difference = node[c][j] - loop[c][i];
                double square = difference * difference;
                PAVIOR_ROUNDED(square);
                distance += square;
            }
            weights[i * weight_tile + j] = 1.0 / distance;
            sum += weights[i * weight_tile + j];
        }
        sums[j] = sum;
    }
}

/// Adds the weighted means of the residuals: out[c * stride + j] += sum_i weights_ij strip[i * strip_columns + c] /
/// sums[j], for weight_tile nodes j and strip_columns columns c.
inline void weighted_residuals_scalar(const double* weights, const double* sums, const double* strip,
                                      std::size_t loop_size, double* out, std::size_t stride) {
    for (std::size_t c = 0; c < strip_columns; ++c) {
        for (std::size_t j = 0; j < weight_tile; ++j) {
            double sum = 0.0;
            for (std::size_t i = 0; i < loop_size; ++i) {
                double product = weights[i * weight_tile + j] * strip[i * strip_columns + c];
                PAVIOR_ROUNDED(product);
                sum += product;
            }
            out[c * stride + j] += sum / sums[j];
        }
    }
}

#if defined(PAVIOR_HAS_VECTOR_KERNELS)

using DoubleX2 __attribute__((vector_size(16))) = double;
using DoubleX4 __attribute__((vector_size(32))) = double;
using DoubleX8 __attribute__((vector_size(64))) = double;

#if defined(__clang__)
#define PAVIOR_KERNEL_UNROLL _Pragma("clang loop unroll(full)")
#define PAVIOR_KERNEL_STREAM(to, vector) \
    __builtin_nontemporal_store(vector, static_cast<PAVIOR_KERNEL_VECTOR*>(static_cast<void*>(to)))
#else
#define PAVIOR_KERNEL_UNROLL _Pragma("GCC unroll 12")
#endif

// sum += a * b, rounded once.
#define PAVIOR_KERNEL_ADD_PRODUCT(sum, a, b) __asm__("vfmadd231pd {%2, %1, %0|%0, %1, %2}" : "+v"(sum) : "v"(a), "v"(b))

// Adds row s of the caps times column s of the matrix.
#define PAVIOR_KERNEL_ADD_ROW(s)                  \
    __builtin_memcpy(&in, row[s] + i, sizeof in); \
    PAVIOR_KERNEL_ADD_PRODUCT(x, in, m##s##0);    \
    PAVIOR_KERNEL_ADD_PRODUCT(y, in, m##s##1);    \
    PAVIOR_KERNEL_ADD_PRODUCT(z, in, m##s##2);

#define PAVIOR_KERNEL_NAME(function) function##_sse2
#define PAVIOR_KERNEL_TARGET
#define PAVIOR_KERNEL_WIDTH 2
#define PAVIOR_KERNEL_COLUMNS 6
#define PAVIOR_KERNEL_VECTOR DoubleX2
#if !defined(__clang__)
#define PAVIOR_KERNEL_STREAM(to, vector) __builtin_ia32_movntpd(to, vector)
#endif
#include <pavior/sweep/detail/node_kernel_body.inc>
#undef PAVIOR_KERNEL_NAME
#undef PAVIOR_KERNEL_TARGET
#undef PAVIOR_KERNEL_WIDTH
#undef PAVIOR_KERNEL_VECTOR

#define PAVIOR_KERNEL_NAME(function) function##_avx2
#define PAVIOR_KERNEL_TARGET __attribute__((target("avx2,fma")))
#define PAVIOR_KERNEL_WIDTH 4
#define PAVIOR_KERNEL_VECTOR DoubleX4
#if !defined(__clang__)
#undef PAVIOR_KERNEL_STREAM
#define PAVIOR_KERNEL_STREAM(to, vector) __builtin_ia32_movntpd256(to, vector)
#endif
#include <pavior/sweep/detail/node_kernel_body.inc>
#undef PAVIOR_KERNEL_NAME
#undef PAVIOR_KERNEL_TARGET
#undef PAVIOR_KERNEL_WIDTH
#undef PAVIOR_KERNEL_COLUMNS
#undef PAVIOR_KERNEL_VECTOR

#define PAVIOR_KERNEL_NAME(function) function##_avx512
#define PAVIOR_KERNEL_TARGET __attribute__((target("avx512f,fma")))
#define PAVIOR_KERNEL_WIDTH 8
#define PAVIOR_KERNEL_COLUMNS 12
#define PAVIOR_KERNEL_VECTOR DoubleX8
#if !defined(__clang__)
#undef PAVIOR_KERNEL_STREAM
#define PAVIOR_KERNEL_STREAM(to, vector) __builtin_ia32_movntpd512(to, vector)
#endif
#include <pavior/sweep/detail/node_kernel_body.inc>
#undef PAVIOR_KERNEL_NAME
#undef PAVIOR_KERNEL_TARGET
#undef PAVIOR_KERNEL_WIDTH
#undef PAVIOR_KERNEL_COLUMNS
#undef PAVIOR_KERNEL_VECTOR
#undef PAVIOR_KERNEL_STREAM
#undef PAVIOR_KERNEL_UNROLL
#undef PAVIOR_KERNEL_ADD_ROW
#undef PAVIOR_KERNEL_ADD_PRODUCT

#endif

}  // namespace detail

/// The widest instruction set of this machine that the kernels were compiled for. O(1), thread-safe.
[[nodiscard]] inline InstructionSet best_instruction_set() {
#if defined(PAVIOR_HAS_VECTOR_KERNELS)
    static const InstructionSet best = !__builtin_cpu_supports("fma")      ? InstructionSet::sse2
                                       : __builtin_cpu_supports("avx512f") ? InstructionSet::avx512
                                       : __builtin_cpu_supports("avx2")    ? InstructionSet::avx2
                                                                           : InstructionSet::sse2;
    return best;
#else
    return InstructionSet::scalar;
#endif
}

/// How apply_level() works.
struct KernelOptions {
    InstructionSet instructions =
        best_instruction_set();  ///< must exist on this machine; the result does not depend on it
    /// Write past the caches: faster when the output is far larger than they are and not read at once. Another thread
    /// may read it after finish_streaming().
    bool stream = false;
};

/// Positions of nodes [begin, end) of one level: out[3 * (i - begin) + c] is coordinate c of node i, computed as
/// centre_c + linear_0c w_0 + ... + linear_5c w_5 from left to right, each term by a fused multiply-add, plus
/// correction[c * stride + (i - begin)] unless \p correction is null. The bits do not depend on \p options, on the
/// machine, nor on how the nodes are cut into ranges. 36 flops a node; where the processor has no fused multiply-add
/// (x86-64 before 2013) the C library computes it, slower by a factor of fifty. Thread-safe on disjoint ranges.
inline void apply_level(const LevelOperator& level, const CapCoordinates& caps, const double* correction,
                        std::size_t stride, std::size_t begin, std::size_t end, double* out,
                        const KernelOptions& options = {}) {
    switch (options.instructions) {
#if defined(PAVIOR_HAS_VECTOR_KERNELS)
        case InstructionSet::avx512:
            return detail::apply_level_avx512(level, caps, correction, stride, begin, end, out, options.stream);
        case InstructionSet::avx2:
            return detail::apply_level_avx2(level, caps, correction, stride, begin, end, out, options.stream);
#endif
        default: return detail::apply_level_scalar(level, caps, correction, stride, begin, end, out);
    }
}

/// Makes what this thread streamed visible to threads that synchronise with it afterwards.
inline void finish_streaming() {
#if defined(PAVIOR_HAS_VECTOR_KERNELS)
    __builtin_ia32_sfence();
#endif
}

namespace detail {

/// inverse_square_weights_scalar() with the given instructions, the same bits.
inline void inverse_square_weights(InstructionSet instructions, const double* const* node, const double* const* loop,
                                   std::size_t loop_size, double* weights, double* sums) {
    switch (instructions) {
#if defined(PAVIOR_HAS_VECTOR_KERNELS)
        case InstructionSet::avx512: return inverse_square_weights_avx512(node, loop, loop_size, weights, sums);
        case InstructionSet::avx2: return inverse_square_weights_avx2(node, loop, loop_size, weights, sums);
        case InstructionSet::sse2: return inverse_square_weights_sse2(node, loop, loop_size, weights, sums);
#endif
        default: return inverse_square_weights_scalar(node, loop, loop_size, weights, sums);
    }
}

/// weighted_residuals_scalar() with the given instructions, the same bits.
inline void weighted_residuals(InstructionSet instructions, const double* weights, const double* sums,
                               const double* strip, std::size_t loop_size, double* out, std::size_t stride) {
    switch (instructions) {
#if defined(PAVIOR_HAS_VECTOR_KERNELS)
        case InstructionSet::avx512: return weighted_residuals_avx512(weights, sums, strip, loop_size, out, stride);
        case InstructionSet::avx2: return weighted_residuals_avx2(weights, sums, strip, loop_size, out, stride);
        case InstructionSet::sse2: return weighted_residuals_sse2(weights, sums, strip, loop_size, out, stride);
#endif
        default: return weighted_residuals_scalar(weights, sums, strip, loop_size, out, stride);
    }
}

}  // namespace detail
}  // namespace pavior
