"""The editor of hairstyles: the seven steps of Choe, Ko 2005, section 6, in their order."""
