#pragma once

// The instruction set a block is laid out and rounded by. Blocks, models and all functions of them live in an inline
// namespace of that name: code that is compiled for another set than the library doesn't link, and the linker's message
// names both.
#if defined(__AVX512F__)
#define ALBEDO_INSTRUCTION_SET avx512
#elif defined(__AVX__) && defined(__FMA__)
#define ALBEDO_INSTRUCTION_SET avx_fma
#elif defined(__AVX__)
#define ALBEDO_INSTRUCTION_SET avx
#elif defined(__SSE2__)
#define ALBEDO_INSTRUCTION_SET sse2
#elif defined(__aarch64__)
#define ALBEDO_INSTRUCTION_SET neon
#else
#define ALBEDO_INSTRUCTION_SET generic
#endif
