#pragma once

// Included before every file that is compiled (framework/CMakeLists.txt): calls of these functions
// of the C library become calls of SLEEF, in our code and in the templates of Eigen, CGAL and
// Boost. The C library selects an implementation by processor, with or without fused multiply-adds,
// and their last bits differ. The `cinz` functions of SLEEF have a single implementation without
// fused multiply-adds, accurate to 1 ulp (erfc: 1.5 ulp).
//
// GCC combines the sine and cosine of the same angle into a call of `sincos`, which no pragma
// renames; -fno-builtin-sin and -fno-builtin-cos prevent that. SLEEF has no long double functions.
// test/house/libm_test.cpp checks that the program calls neither these nor other inexact functions
// of the C library.

#pragma redefine_extname sin Sleef_cinz_sind1_u10purec
#pragma redefine_extname cos Sleef_cinz_cosd1_u10purec
#pragma redefine_extname tan Sleef_cinz_tand1_u10purec
#pragma redefine_extname asin Sleef_cinz_asind1_u10purec
#pragma redefine_extname acos Sleef_cinz_acosd1_u10purec
#pragma redefine_extname atan Sleef_cinz_atand1_u10purec
#pragma redefine_extname atan2 Sleef_cinz_atan2d1_u10purec
#pragma redefine_extname sinh Sleef_cinz_sinhd1_u10purec
#pragma redefine_extname cosh Sleef_cinz_coshd1_u10purec
#pragma redefine_extname tanh Sleef_cinz_tanhd1_u10purec
#pragma redefine_extname asinh Sleef_cinz_asinhd1_u10purec
#pragma redefine_extname acosh Sleef_cinz_acoshd1_u10purec
#pragma redefine_extname atanh Sleef_cinz_atanhd1_u10purec
#pragma redefine_extname exp Sleef_cinz_expd1_u10purec
#pragma redefine_extname exp2 Sleef_cinz_exp2d1_u10purec
#pragma redefine_extname expm1 Sleef_cinz_expm1d1_u10purec
#pragma redefine_extname log Sleef_cinz_logd1_u10purec
#pragma redefine_extname log2 Sleef_cinz_log2d1_u10purec
#pragma redefine_extname log10 Sleef_cinz_log10d1_u10purec
#pragma redefine_extname log1p Sleef_cinz_log1pd1_u10purec
#pragma redefine_extname pow Sleef_cinz_powd1_u10purec
#pragma redefine_extname cbrt Sleef_cinz_cbrtd1_u10purec
#pragma redefine_extname hypot Sleef_cinz_hypotd1_u05purec
#pragma redefine_extname erf Sleef_cinz_erfd1_u10purec
#pragma redefine_extname erfc Sleef_cinz_erfcd1_u15purec
#pragma redefine_extname tgamma Sleef_cinz_tgammad1_u10purec
#pragma redefine_extname lgamma Sleef_cinz_lgammad1_u10purec

#pragma redefine_extname sinf Sleef_cinz_sinf1_u10purec
#pragma redefine_extname cosf Sleef_cinz_cosf1_u10purec
#pragma redefine_extname tanf Sleef_cinz_tanf1_u10purec
#pragma redefine_extname asinf Sleef_cinz_asinf1_u10purec
#pragma redefine_extname acosf Sleef_cinz_acosf1_u10purec
#pragma redefine_extname atanf Sleef_cinz_atanf1_u10purec
#pragma redefine_extname atan2f Sleef_cinz_atan2f1_u10purec
#pragma redefine_extname sinhf Sleef_cinz_sinhf1_u10purec
#pragma redefine_extname coshf Sleef_cinz_coshf1_u10purec
#pragma redefine_extname tanhf Sleef_cinz_tanhf1_u10purec
#pragma redefine_extname asinhf Sleef_cinz_asinhf1_u10purec
#pragma redefine_extname acoshf Sleef_cinz_acoshf1_u10purec
#pragma redefine_extname atanhf Sleef_cinz_atanhf1_u10purec
#pragma redefine_extname expf Sleef_cinz_expf1_u10purec
#pragma redefine_extname exp2f Sleef_cinz_exp2f1_u10purec
#pragma redefine_extname expm1f Sleef_cinz_expm1f1_u10purec
#pragma redefine_extname logf Sleef_cinz_logf1_u10purec
#pragma redefine_extname log2f Sleef_cinz_log2f1_u10purec
#pragma redefine_extname log10f Sleef_cinz_log10f1_u10purec
#pragma redefine_extname log1pf Sleef_cinz_log1pf1_u10purec
#pragma redefine_extname powf Sleef_cinz_powf1_u10purec
#pragma redefine_extname cbrtf Sleef_cinz_cbrtf1_u10purec
#pragma redefine_extname hypotf Sleef_cinz_hypotf1_u05purec
#pragma redefine_extname erff Sleef_cinz_erff1_u10purec
#pragma redefine_extname erfcf Sleef_cinz_erfcf1_u15purec
#pragma redefine_extname tgammaf Sleef_cinz_tgammaf1_u10purec
#pragma redefine_extname lgammaf Sleef_cinz_lgammaf1_u10purec
