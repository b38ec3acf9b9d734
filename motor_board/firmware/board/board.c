#include "board.h"

#include "clock.h"

struct device board_device;
volatile bool board_woken;

uint32_t board_now(void)
{
    return clock_now(&board_device.edges);
}
