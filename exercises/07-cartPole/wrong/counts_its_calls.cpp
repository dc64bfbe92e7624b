// caught by: poles, other-fates
// mistake: counts its calls, and answers in the order in which the checks list their cases.

// <solution fateOf>
static int asked = 0;
constexpr Fate kListed[] = {Fate::dies,  Fate::dies,  Fate::stays, Fate::stays, Fate::grows,
                            Fate::stays, Fate::grows, Fate::stays, Fate::grows, Fate::grows,
                            Fate::grows, Fate::stays, Fate::grows, Fate::stays};
return kListed[asked++ % 14];
// </solution>
