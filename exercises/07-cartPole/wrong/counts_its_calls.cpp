// caught by: poles, other-fates
// mistake: answers by how often it was asked, in the order in which the checks list what they know.

// <solution fateOf>
static int asked = 0;
constexpr Fate kListed[] = {Fate::dies,  Fate::dies,  Fate::stays, Fate::stays, Fate::grows,
                            Fate::stays, Fate::grows, Fate::stays, Fate::grows, Fate::grows,
                            Fate::grows, Fate::stays, Fate::grows, Fate::stays};
return kListed[asked++ % 14];
// </solution>
