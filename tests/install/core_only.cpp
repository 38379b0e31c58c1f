/* C++, and libheightcast alone. */
#include <heightcast/heightcast.h>

#include <vector>

int main()
{
    std::vector<float> heights(32 * 32), ratios(32 * 32);
    hc_field           field = {};
    field.heights            = heights.data();
    field.width              = 32;
    field.height             = 32;
    return hc_synth(heights.data(), 32, 32, "noise", 1, nullptr) != HC_OK
           || hc_bake_cone_map(ratios.data(), &field, nullptr, nullptr) != HC_OK;
}
