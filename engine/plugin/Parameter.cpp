#include "teren/Parameter.h"
