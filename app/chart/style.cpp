#include "app/chart/chart.hpp"

namespace clay::chart {

// Hues that are distinguishable with colour blindness; shapes and dashes distinguish curves without
// colour.
std::string_view style() {
  return R"css(
.plot text { font: 13px system-ui, "DejaVu Sans", Arial, sans-serif; fill: #2b2b2b; stroke: none; }
.plot .name { font-size: 15px; font-weight: 600; }
.plot .back { fill: #ffffff; }
.plot .box { fill: none; stroke: #8a8a8a; }
.plot .grid { stroke: #d4d4d4; } .plot .minor { stroke: #ededed; }
.plot .cell { stroke: #ffffff; stroke-width: 1; } .plot .cell-dot { fill: #5a2500; }
.plot .none { fill: none; stroke: #b5b5b5; stroke-dasharray: 2 3; }
.plot .line { fill: none; stroke-width: 1.8; stroke-linejoin: round; }
.plot .band { stroke: none; fill-opacity: 0.16; } .plot .bar { fill: none; stroke-width: 1.1; }
.plot .label { font-size: 10px; }
.plot .mark { stroke-width: 1; } .plot .zero { fill: #ffffff; stroke-width: 1.6; }
.plot .s0 { stroke: #0072b2; } .plot .f0 { fill: #0072b2; }
.plot .s1 { stroke: #d55e00; } .plot .f1 { fill: #d55e00; }
.plot .s2 { stroke: #007d5e; } .plot .f2 { fill: #007d5e; }
.plot .s3 { stroke: #a8327d; } .plot .f3 { fill: #a8327d; }
.plot .s4 { stroke: #8f6a00; } .plot .f4 { fill: #8f6a00; }
.plot .s5 { stroke: #555555; } .plot .f5 { fill: #555555; }
.plot .s6 { stroke: #4b3fb5; } .plot .f6 { fill: #4b3fb5; }
.plot .on-map { stroke: #111111; stroke-width: 2.4; } .plot .under { stroke: #ffffff; stroke-width: 5; }
.plot .fill-ink { fill: #111111; } .plot .pale { fill: #f4eedd; }
@media screen and (prefers-color-scheme: dark) {
.plot text { fill: #dcdcdc; } .plot .back { fill: #16191d; } .plot .box { stroke: #7d838a; }
.plot .grid { stroke: #363c43; } .plot .minor { stroke: #24292e; }
.plot .cell { stroke: #16191d; } .plot .none { stroke: #5b626a; } .plot .zero { fill: #16191d; }
.plot .s0 { stroke: #56b4e9; } .plot .f0 { fill: #56b4e9; }
.plot .s1 { stroke: #ff8d4e; } .plot .f1 { fill: #ff8d4e; }
.plot .s2 { stroke: #33c79f; } .plot .f2 { fill: #33c79f; }
.plot .s3 { stroke: #e68cc4; } .plot .f3 { fill: #e68cc4; }
.plot .s4 { stroke: #e6bb3c; } .plot .f4 { fill: #e6bb3c; }
.plot .s5 { stroke: #bdbdbd; } .plot .f5 { fill: #bdbdbd; }
.plot .s6 { stroke: #a79bff; } .plot .f6 { fill: #a79bff; }
}
)css";
}

}  // namespace clay::chart
