// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers

// The loops of solidem_packs.h for x86-64-v3, whatever the compiler's flags are. Headers that do
// not belong to them come first, so that nothing of theirs is compiled for machines like that.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#ifndef NDEBUG
#define NDEBUG
#endif
#include <immintrin.h>

#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>
#include <variant>

#pragma GCC optimize("O3")
#pragma GCC target("avx2,fma,bmi,bmi2")
// g++ 12 has not yet told the preprocessor of that.
#ifndef __AVX__
#define __AVX__ 1
#endif
#define SOLIDEM_INSTRUCTION_SET x86_64_v3
#include "solidem_packs.h"
#endif
