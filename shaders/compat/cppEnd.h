// SPDX-License-Identifier: Apache-2.0
// Takes back the macros of shaders/compat/cpp.h.
#undef PATINA_FN
#undef PATINA_FN_RARE
#undef PATINA_OUT
#undef PATINA_INOUT
#undef PATINA_UNUSED
#undef PATINA_ENERGY_KNOWN
#undef PATINA_COMPENSATE
#undef PATINA_ALBEDO_METHOD
#undef PATINA_FILM
#undef PATINA_FILM_METHOD
