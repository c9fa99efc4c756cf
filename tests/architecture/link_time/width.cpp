/// Of a register in bits: the same name in each variant.
__attribute__((noinline)) inline int register_width() {
#ifdef __AVX2__
  return 256;
#else
  return 128;
#endif
}

#define ENTRY_OF(variant) width_##variant
#define ENTRY(variant) ENTRY_OF(variant)

extern "C" int ENTRY(RAYTRACE_VARIANT)() { return register_width(); }
