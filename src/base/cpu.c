/* Which vector kernels this machine and this build can run. */
#include <heightcast/result.h>

static bool runs(hc_isa isa)
{
#if defined(HC_FORCE_SCALAR) || !(defined(__x86_64__) && defined(__GNUC__))
    return isa == HC_ISA_SCALAR;
#else
    switch (isa) {
    case HC_ISA_AVX512:
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")
               && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
    case HC_ISA_AVX2:
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")
               && __builtin_cpu_supports("bmi2");
    default: return isa == HC_ISA_SCALAR;
    }
#endif
}

hc_isa hc_isa_resolve(hc_isa wanted)
{
    const hc_isa widest = wanted == HC_ISA_AUTO ? HC_ISA_AVX512 : wanted;
    for (int isa = (int)widest; isa > (int)HC_ISA_SCALAR; isa--) {
        if (runs((hc_isa)isa)) {
            return (hc_isa)isa;
        }
    }
    return HC_ISA_SCALAR;
}

const char *hc_isa_name(hc_isa isa)
{
    static const char *const names[] = { "auto", "scalar", "avx2", "avx512" };
    const unsigned           index   = (unsigned)isa;
    return index < sizeof names / sizeof *names ? names[index] : "unknown";
}
