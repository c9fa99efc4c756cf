extern "C" int width_v2();
extern "C" int width_v3();

int main() { return width_v2() == 128 && width_v3() == 256 ? 0 : 1; }
