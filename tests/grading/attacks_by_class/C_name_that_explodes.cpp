// Calls a missing function under a short mangled name that unfolds to some hundred million letters when it is
// made readable. It is not meant to link: the message about it is the attack.
#include "exercise.h"

double missing(double x) asm(
    "_Z7missing1PIS_IS_IS_IS_IS_IS_IS_IS_IS_IS_IS_IS_IS_IS_IS_IS_IS_IS_IS_IS_IS_IS_IS_IiiES0_ES1_ES2_ES3_ES4_"
    "ES5_ES6_ES7_ES8_ES9_ESA_ESB_ESC_ESD_ESE_ESF_ESG_ESH_ESI_ESJ_ESK_ESL_ESM_E");

double twice(double x) { return missing(x); }

std::vector<double> squares(int) { return {}; }
int main() {}
