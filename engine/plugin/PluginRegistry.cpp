#include "teren/PluginRegistry.h"
