// A trade's report of made-up numbers as they may be: six views, fourteen settings, eleven effects.
#pragma once

#include "apps/trade/trade_report.h"

namespace oro::test {

TradeReport sample_report();

}  // namespace oro::test
